// SPDX-License-Identifier: Apache-2.0
#include "tlm/stream_base.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tlm/error.hpp"

namespace parallax {
namespace {

std::uint64_t ring_mask(std::uint32_t depth) {
  std::uint64_t size = 1;
  while (size <= depth) size *= 2;  // one more than depth: settle_occupancy() looks one read further back
  return size - 1;
}

const FifoConfig& checked(const char* name, const FifoConfig& config) {
  if (config.depth < 1 || config.depth > StreamBase::kLargestDepth) {
    throw UserError(fmt::format("stream '{}': depth {} is outside 1 to {} tokens", name, config.depth,
                                StreamBase::kLargestDepth));
  }
  if (config.write_to_read < 1 || config.read_to_write < 1) {
    throw UserError(fmt::format("stream '{}': a registered FIFO needs at least 1 cycle each way", name));
  }
  return config;
}

}  // namespace

StreamBase::StreamBase(const char* name, Dataflow& dataflow, const ClockDomain& writer_clock,
                       const ClockDomain& reader_clock, const FifoConfig& config)
    : sc_prim_channel(name),
      config_(checked(name, config)),
      dataflow_(dataflow),
      writer_clock_(writer_clock),
      reader_clock_(reader_clock),
      same_clock_(writer_clock.frequency() == reader_clock.frequency()),
      mask_(ring_mask(config.depth)),
      write_dates_(mask_ + 1),
      read_dates_(mask_ + 1) {
  dataflow.add(*this);
}

void StreamBase::attach_writer(const std::string& module, Actor* actor) {
  if (writer_name_ == "nobody" || module.size() > writer_name_.size()) {
    writer_name_ = module;
    writer_ = actor;
  }
}

void StreamBase::attach_reader(const std::string& module, Actor* actor) {
  if (reader_name_ == "nobody" || module.size() > reader_name_.size()) {
    reader_name_ = module;
    reader_ = actor;
  }
}

void StreamBase::mark_read(Cycles cycle, Cycles starved) {
  read_dates_[statistics_.read & mask_] = cycle;
  statistics_.starved_on_empty += starved;
  ++statistics_.read;
  last_read_ = cycle;
  if (listener_ != nullptr) listener_->read(*this, cycle);
  settle_occupancy();
  if (std::exchange(writer_waits_, false)) {
    if (writer_ != nullptr) {
      dataflow_.wake(*writer_);
    } else {
      read_.notify();
    }
  }
}

void StreamBase::mark_written(Cycles cycle, Cycles blocked) {
  write_dates_[statistics_.written & mask_] = cycle;
  statistics_.blocked_on_full += blocked;
  ++statistics_.written;
  last_write_ = cycle;
  if (listener_ != nullptr) listener_->written(*this, cycle);
  if (std::exchange(reader_waits_, false)) {
    if (reader_ != nullptr) {
      dataflow_.wake(*reader_);
    } else {
      written_.notify();
    }
  }
}

// Counts how full the FIFO was after each write, once every read that made room before it is known: the reads
// are known in order, so that is when one is known that makes room later than the write.
void StreamBase::settle_occupancy() {
  const Cycles room = backward(read_dates_[(statistics_.read - 1) & mask_]);
  while (settled_writes_ < statistics_.written) {
    const Cycles written = write_dates_[settled_writes_ & mask_];
    if (written >= room) break;
    while (freed_ < statistics_.read && backward(read_dates_[freed_ & mask_]) <= written) ++freed_;
    ++settled_writes_;
    statistics_.high_water = std::max(statistics_.high_water, settled_writes_ - freed_);
  }
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
  // Tokens before this one may be committed meanwhile, so its place counts from the first, not from the next.
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
