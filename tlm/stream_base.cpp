// SPDX-License-Identifier: Apache-2.0
#include "tlm/stream_base.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "tlm/error.hpp"
#include "tlm/ring_copy.hpp"

namespace parallax {
namespace {

// What settle() counts; all zero between two calls, which sets to zero no more than was counted.
thread_local std::array<Cycles, Occupancy::kMaxBins> at_least;

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

void StreamBase::readable_at(std::size_t count, Cycles* dates) const {
  copy_out_of_ring(write_dates_.data(), history(), statistics_.read, count, dates);
  if (same_frequency_) {
    const Cycles offset(config_.write_to_read);
    for (std::size_t i = 0; i < count; ++i) dates[i] += offset;
  } else {
    for (std::size_t i = 0; i < count; ++i) dates[i] = forward(dates[i]);
  }
}

void StreamBase::writable_at(std::size_t count, Cycles* dates) const {
  if (statistics_.written < config_.depth) {
    for (std::size_t i = 0; i < count; ++i) dates[i] = writable_at(i);
    return;
  }
  copy_out_of_ring(read_dates_.data(), history(), statistics_.written - config_.depth, count, dates);
  if (same_frequency_) {
    const Cycles offset(config_.read_to_write);
    for (std::size_t i = 0; i < count; ++i) dates[i] += offset;
  } else {
    for (std::size_t i = 0; i < count; ++i) dates[i] = backward(dates[i]);
  }
}

void StreamBase::mark_read(const Cycles* cycles, std::size_t count, Cycles starved) {
  const std::uint64_t before = statistics_.read;
  copy_into_ring(cycles, count, read_dates_.data(), history(), before);
  statistics_.starved_on_empty += starved;
  statistics_.read += count;
  last_read_ = cycles[count - 1];
  if (listeners_.any()) std::for_each(cycles, cycles + count, [this](Cycles cycle) { notify_read(cycle); });
  if (statistics_.read / kSettleInterval != before / kSettleInterval) settle();
  if (writer_waits_) wake_writer();
}

void StreamBase::mark_written(const Cycles* cycles, std::size_t count, Cycles blocked) {
  copy_into_ring(cycles, count, write_dates_.data(), history(), statistics_.written);
  statistics_.blocked_on_full += blocked;
  statistics_.written += count;
  last_write_ = cycles[count - 1];
  if (listeners_.any())
    std::for_each(cycles, cycles + count, [this](Cycles cycle) { notify_written(cycle); });
  if (reader_waits_) wake_reader();
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
template <class Rise, class Fall>
void StreamBase::go_through_levels(Rise rise, Fall fall) const {
  const std::uint64_t written = statistics_.written;
  const std::uint64_t read = statistics_.read;
  std::uint64_t writes = settled_writes_;
  std::uint64_t frees = freed_;
  const auto write_at = [&](std::uint64_t token) { return write_dates_[token & mask_]; };
  const auto room_at = [&](std::uint64_t token) { return backward(read_dates_[token & mask_]); };
  if (writes != written && frees != read) {
    Cycles write = write_at(writes);
    Cycles room = room_at(frees);
    for (;;) {
      // First a token that leaves, where both come in one cycle: in its last cycle it still counts.
      if (room <= write) {
        fall(writes - frees, room);
        if (++frees == read) break;
        room = room_at(frees);
      } else {
        ++writes;
        rise(writes - frees, write);
        if (writes == written) break;
        write = write_at(writes);
      }
    }
  }
  for (const Cycles next = backward(last_read_ + Cycles(1)); writes != written && frees == read;) {
    const Cycles write = write_at(writes);
    if (next <= write) break;
    ++writes;
    rise(writes - frees, write);
  }
  for (const Cycles next = last_write_ + Cycles(1); frees != read && writes == written;) {
    const Cycles room = room_at(frees);
    if (room > next) break;
    fall(writes - frees, room);
    ++frees;
  }
  settled_writes_ = writes;
  freed_ = frees;
}

void StreamBase::settle() const {
  if (settled_writes_ == statistics_.written && freed_ == statistics_.read) return;
  if (counted_ != nullptr || occupancy_.bin_width() != 1) return settle_one_by_one();
  // The time at level l or above is the sum of the dates at which it falls below l, less those at which it
  // rises to l: an addition a date.
  const auto level = [this] { return static_cast<std::int64_t>(settled_writes_ - freed_); };
  const std::int64_t level_before = level();
  std::int64_t lowest = level_before;
  std::int64_t highest = level_before;
  Cycles until = settled_until_;
  go_through_levels(
      [&](std::uint64_t to, Cycles date) {
        at_least[to] -= date;
        highest = std::max(highest, static_cast<std::int64_t>(to));
        until = date;
      },
      [&](std::uint64_t from, Cycles date) {
        at_least[from] += date;
        lowest = std::min(lowest, static_cast<std::int64_t>(from) - 1);
        until = date;
      });
  const std::int64_t level_after = level();
  Cycles above(0);
  for (std::int64_t l = highest; l > lowest; --l) {
    Cycles here = std::exchange(at_least[l], Cycles(0));
    if (l <= level_before) here -= settled_until_;
    if (l <= level_after) here += until;
    occupancy_.add(l, (here - above).count());
    above = here;
  }
  if (lowest >= 0) occupancy_.add(lowest, (until - settled_until_ - above).count());
  statistics_.high_water = std::max<std::uint64_t>(statistics_.high_water, highest);
  settled_until_ = until;
}

// As settle(), for deep FIFOs and for Leap.
void StreamBase::settle_one_by_one() const {
  const auto pass = [this](std::uint64_t level, Cycles date) {
    if (date <= settled_until_) return;
    const std::uint64_t cycles = (date - settled_until_).size();
    occupancy_.add(level, cycles);
    if (counted_ != nullptr) counted_->emplace_back(level, cycles);
    settled_until_ = date;
  };
  go_through_levels(
      [&](std::uint64_t to, Cycles date) {
        pass(to - 1, date);
        statistics_.high_water = std::max(statistics_.high_water, to);
      },
      pass);
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
