// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <systemc>
#include <utility>

#include "tests/bench/chain_load.hpp"
#include "tests/bench/cpu_seconds.hpp"
#include "tests/tlm/thread.hpp"

namespace parallax::bench {

/// A FIFO whose cells know when they were written and when they were read, for threads that keep a time of
/// their own (temporal decoupling; C. Helmstetter et al., "Fast and Accurate TLM Simulations using Temporal
/// Decoupling for FIFO-based Communications", DATE 2013). A thread gives way only when no cell is left to go
/// on with.
class DatedFifo {
 public:
  explicit DatedFifo(std::uint32_t depth) : cells_(depth) {}

  /// Reads a token not before cycle `earliest`; returns the cycle.
  std::int64_t read(std::int64_t earliest, int& value) {
    while (held_ == 0) {
      reader_waits_ = true;
      sc_core::wait(written_event_);
    }
    Cell& cell = cells_[next_read_];
    if (++next_read_ == cells_.size()) next_read_ = 0;
    value = cell.value;
    cell.read = std::max(earliest, cell.written + 1);
    --held_;
    if (std::exchange(writer_waits_, false)) read_event_.notify();
    return cell.read;
  }

  /// Writes a token not before cycle `earliest`; returns the cycle.
  std::int64_t write(std::int64_t earliest, int value) {
    while (held_ == cells_.size()) {
      writer_waits_ = true;
      sc_core::wait(read_event_);
    }
    Cell& cell = cells_[next_write_];
    if (++next_write_ == cells_.size()) next_write_ = 0;
    cell.value = value;
    cell.written = std::max(earliest, cell.read + 1);
    ++held_;
    if (std::exchange(reader_waits_, false)) written_event_.notify();
    return cell.written;
  }

 private:
  struct Cell {
    std::int64_t written = -1;
    std::int64_t read = -1;
    int value = 0;
  };
  std::vector<Cell> cells_;
  std::size_t next_read_ = 0;
  std::size_t next_write_ = 0;
  std::size_t held_ = 0;
  bool reader_waits_ = false;
  bool writer_waits_ = false;
  sc_core::sc_event read_event_;
  sc_core::sc_event written_event_;
};

/// Dated cells with temporal decoupling: a thread a stage with a time of its own, and no kernel time at all.
inline ChainRun run_dated_fifo(const ChainLoad& load) {
  const std::uint64_t tokens = load.tokens();
  std::vector<std::unique_ptr<DatedFifo>> fifos;
  for (int i = 0; i <= kStages; ++i) fifos.push_back(std::make_unique<DatedFifo>(load.depth));
  const test::Thread source("source", [&] {
    Gaps gaps(load.source_gaps);
    std::int64_t now = 0;
    for (std::uint64_t token = 0; token < tokens; ++token) now = fifos.front()->write(now, 1) + gaps.next();
  });
  std::vector<std::unique_ptr<test::Thread>> stages;
  for (std::size_t stage = 0; stage < kStages; ++stage) {
    stages.push_back(std::make_unique<test::Thread>(fmt::format("n{}", stage).c_str(), [&, stage] {
      std::int64_t now = 0;
      for (int value = 0;;) {
        now = fifos[stage]->read(now, value);
        now = fifos[stage + 1]->write(now + 1, value);
      }
    }));
  }
  std::int64_t last_read = 0;
  const test::Thread sink("sink", [&] {
    Gaps gaps(load.sink_gaps);
    std::int64_t now = 0;
    for (std::uint64_t token = 0; token < tokens; ++token) {
      int value = 0;
      last_read = fifos.back()->read(now, value);
      now = last_read + gaps.next();
    }
  });

  const double began = cpu_seconds();
  sc_core::sc_start();
  return {cpu_seconds() - began, last_read};
}

}  // namespace parallax::bench
