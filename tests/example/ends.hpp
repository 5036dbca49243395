// SPDX-License-Identifier: Apache-2.0
// What stands before and behind a stage of one's own in a test: blocks in kernel time.
#pragma once

#include <cstdint>
#include <systemc>
#include <utility>
#include <vector>

#include "modules/pixel.hpp"
#include "tlm/clock_domain.hpp"
#include "tlm/stage.hpp"

namespace parallax::test {

/// A row's values enter with its first token, or one by one.
enum class Sending { kRows, kTokens };

/// Sends the same row `rows` times.
class Source final : public sc_core::sc_module {
 public:
  StreamOut<Disparity> out{"out"};
  Source(const sc_core::sc_module_name& name, std::vector<Disparity> row, Sending sending, int rows = 1)
      : sc_module(name), row_(std::move(row)), sending_(sending), rows_(rows) {
    SC_HAS_PROCESS(Source);
    SC_THREAD(run);
  }

 private:
  void run() {
    for (int y = 0; y < rows_; ++y) send();
  }
  void send() {
    if (sending_ == Sending::kRows) out.send_row(row_.data(), row_.size());
    for (const Disparity& value : row_) {
      if (sending_ == Sending::kTokens) {
        out->write(value);
      } else {
        out->wait_writable();
        out->commit();
      }
    }
  }
  const std::vector<Disparity> row_;
  const Sending sending_;
  const int rows_;
};

/// Takes what comes, at once.
class Sink final : public sc_core::sc_module {
 public:
  StreamIn<Disparity> in{"in"};
  std::vector<Disparity> values;
  std::vector<std::int64_t> cycles;
  Sink(const sc_core::sc_module_name& name, const ClockDomain& clock) : sc_module(name), clock_(clock) {
    SC_HAS_PROCESS(Sink);
    SC_THREAD(run);
  }

 private:
  void run() {
    for (;;) {
      values.push_back(in->read());
      cycles.push_back(clock_.now().count());
    }
  }
  const ClockDomain& clock_;
};

}  // namespace parallax::test
