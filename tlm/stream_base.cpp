// SPDX-License-Identifier: Apache-2.0
#include "tlm/stream_base.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tlm/error.hpp"
#include "tlm/leap_history.hpp"

namespace parallax {
namespace {

// Beyond the depth, a ring holds the dates that settle() has not counted yet, and the history in which
// periodic motion is recognised.
std::uint64_t ring_mask(std::uint32_t depth) {
  std::uint64_t size = 1;
  while (size < depth + kLeapHistory) size *= 2;
  return size - 1;
}

// The configuration with the offsets of its kind.
FifoConfig checked(const char* name, FifoConfig config, const ClockDomain& writer,
                   const ClockDomain& reader) {
  if (config.depth < 1 || config.depth > StreamBase::kLargestDepth) {
    throw UserError(fmt::format("stream '{}': depth {} is outside 1 to {} tokens", name, config.depth,
                                StreamBase::kLargestDepth));
  }
  const bool one_clock = &writer == &reader;
  if (config.kind != FifoKind::kFree) {
    if (config.write_to_read != 1 || config.read_to_write != 1) {
      throw UserError(fmt::format("stream '{}': a FIFO of kind {} has offsets of its own, none can be given",
                                  name, name_of(config.kind)));
    }
    if (config.kind != FifoKind::kAsynchronous && !one_clock) {
      throw UserError(
          fmt::format("stream '{}': a FIFO of kind {} cannot stand between the clocks '{}' and '{}'; an "
                      "asynchronous one can",
                      name, name_of(config.kind), writer.name(), reader.name()));
    }
    for (const std::uint32_t stages :
         {config.synchroniser_stages.to_reader, config.synchroniser_stages.to_writer}) {
      if (stages >= 1 && stages <= SynchroniserStages::kMost) continue;
      throw UserError(fmt::format("stream '{}': {} synchroniser stages are outside 1 to {}", name, stages,
                                  SynchroniserStages::kMost));
    }
    const FifoOffsets offsets = offsets_of(config.kind, config.synchroniser_stages);
    config.write_to_read = offsets.write_to_read;
    config.read_to_write = offsets.read_to_write;
  } else if ((config.write_to_read == 0 || config.read_to_write == 0) && !one_clock) {
    throw UserError(
        fmt::format("stream '{}': an offset of 0 cycles cannot be kept between the clocks '{}' and '{}'",
                    name, writer.name(), reader.name()));
  }
  return config;
}

}  // namespace

StreamBase::StreamBase(const char* name, Dataflow& dataflow, const ClockDomain& writer_clock,
                       const ClockDomain& reader_clock, const FifoConfig& config)
    : sc_prim_channel(name),
      config_(checked(name, config, writer_clock, reader_clock)),
      dataflow_(dataflow),
      writer_clock_(writer_clock),
      reader_clock_(reader_clock),
      same_frequency_(writer_clock.frequency() == reader_clock.frequency()),
      mask_(ring_mask(config.depth)),
      write_dates_(mask_ + 1),
      read_dates_(mask_ + 1),
      occupancy_(config.depth) {
  dataflow.add(*this);
}

void StreamBase::require_width(Bits tokens) const {
  if (config_.inside_stage || config_.width >= tokens) return;  // inside there are no wires
  throw UserError(fmt::format("stream '{}': its width is {} bits, and its tokens have {} (FifoConfig::width)",
                              basename(), config_.width.count(), tokens.count()));
}

void StreamBase::attach_writer(const std::string& module, Actor* actor) {
  if (writer_name_ == kUnbound || module.size() > writer_name_.size()) {
    writer_name_ = module;
    writer_ = actor;
  }
}

void StreamBase::attach_reader(const std::string& module, Actor* actor) {
  if (reader_name_ == kUnbound || module.size() > reader_name_.size()) {
    reader_name_ = module;
    reader_ = actor;
  }
}

void StreamBase::notify_read(Cycles cycle) {
  for (StreamListener* listener : listeners_) listener->read(*this, cycle);
}

void StreamBase::notify_written(Cycles cycle) {
  for (StreamListener* listener : listeners_) listener->written(*this, cycle);
}

void StreamBase::wake_writer() {
  writer_waits_ = false;
  if (writer_ != nullptr) {
    dataflow_.wake(*writer_);
  } else {
    read_.notify();
  }
}

void StreamBase::wake_reader() {
  reader_waits_ = false;
  if (reader_ != nullptr) {
    dataflow_.wake(*reader_);
  } else {
    written_.notify();
  }
}

// Goes through writes and reads in the order in which they change the level. A date counts once it is certain
// that nothing unknown can come before it: each side's next date is later than its last one. With both
// offsets 0 a token may free its slot in the cycle that writes it; the level is then one too low, but for no
// time.
void StreamBase::settle() const {
  std::uint64_t writes = settled_writes_;
  std::uint64_t frees = freed_;
  const std::uint64_t written = statistics_.written;
  const std::uint64_t read = statistics_.read;
  const auto next_write = [&] {
    return writes < written ? write_dates_[writes & mask_] : last_write_ + Cycles(1);
  };
  const auto next_room = [&] {
    return backward(frees < read ? read_dates_[frees & mask_] : last_read_ + Cycles(1));
  };
  if (writes == written && frees == read) return;
  Cycles write = next_write();
  Cycles room = next_room();
  while (writes < written || frees < read) {
    const bool leaves =
        room <= write;  // first, where both come in one cycle: a token in its last cycle still counts
    if (leaves ? frees == read : writes == written) break;
    const Cycles date = leaves ? room : write;
    if (date > settled_until_) {
      const std::uint64_t cycles = (date - settled_until_).size();
      occupancy_.add(writes - frees, cycles);
      if (counted_ != nullptr) counted_->emplace_back(writes - frees, cycles);
      settled_until_ = date;
    }
    if (leaves) {
      ++frees;
      room = next_room();
    } else {
      ++writes;
      statistics_.high_water = std::max(statistics_.high_water, writes - frees);
      write = next_write();
    }
  }
  settled_writes_ = writes;
  freed_ = frees;
}

void StreamBase::fill(FifoFill& fill) const {
  settle();
  fill.until = settled_until_;
  fill.written = settled_writes_;
  fill.freed = freed_;
  fill.token_cycles = occupancy_.level_cycles();
  fill.full_cycles = occupancy_.full();
  fill.empty_cycles = occupancy_.empty();
  if (ahead_.periods_gone == nullptr) return;
  const std::uint64_t periods = *ahead_.periods_gone - *ahead_.periods_added;
  fill.until += ahead_.period * periods;
  fill.written += ahead_.tokens * periods;
  fill.freed += ahead_.tokens * periods;
  fill.token_cycles += ahead_.token_cycles * periods;
  fill.full_cycles += ahead_.full_cycles * periods;
  fill.empty_cycles += ahead_.empty_cycles * periods;
}

void StreamBase::wait_readable() {
  read_wait_began_ = reader_clock_.now();
  while (!read_date_known()) {
    reader_waits_ = true;
    sc_core::wait(written_);
  }
  reader_clock_.wait_until(std::max(readable_at(), last_read_ + Cycles(1)));
}

void StreamBase::release() {
  const Cycles cycle = reader_clock_.now();
  const Cycles starved =
      std::max(Cycles(0), readable_at() - std::max(read_wait_began_, last_read_ + Cycles(1)));
  mark_read(cycle, starved);
}

void StreamBase::wait_writable(std::uint64_t ahead) {
  write_wait_began_ = writer_clock_.now();
  // Tokens before this one may be committed meanwhile, so its slot counts from the first, not from the next.
  const std::uint64_t token = statistics_.written + ahead;
  while (!write_date_known(token - statistics_.written)) {
    writer_waits_ = true;
    sc_core::wait(read_);
  }
  ahead = token - statistics_.written;
  writer_clock_.wait_until(std::max(writable_at(ahead), ahead == 0 ? last_write_ + Cycles(1) : Cycles(0)));
}

void StreamBase::commit(const sc_core::sc_time& time) {
  const Cycles next = last_write_ + Cycles(1);
  const Cycles room = writable_at();
  const Cycles cycle = std::max({writer_clock_.cycle_at_or_after(time), next, room});
  mark_written(cycle, std::max(Cycles(0), room - std::max(write_wait_began_, next)));
}

}  // namespace parallax
