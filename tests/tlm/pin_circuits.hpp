// SPDX-License-Identifier: Apache-2.0
// Circuits with pins, one for each handshake.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <systemc>

namespace parallax::test {

/// Three registers without back-pressure; `ce` holds them. It adds one to what passes.
class PassThree final : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> clk{"clk"}, rst{"rst"}, ce{"ce"}, in_valid{"in_valid"};
  sc_core::sc_in<std::uint32_t> in_data{"in_data"};
  sc_core::sc_out<bool> out_valid{"out_valid"};
  sc_core::sc_out<std::uint32_t> out_data{"out_data"};

  explicit PassThree(const sc_core::sc_module_name& name) : sc_module(name) {
    SC_HAS_PROCESS(PassThree);
    SC_METHOD(edge);
    sensitive << clk.pos();
    dont_initialize();
  }

 private:
  void edge() {
    if (!ce) return;
    out_valid = !rst && valid_[1];
    out_data = data_[1];
    valid_ = {in_valid && !rst, valid_[0] && !rst};
    data_ = {in_data + 1, data_[0]};
  }
  std::array<bool, 2> valid_{};
  std::array<std::uint32_t, 2> data_{};
};

/// A window of three in a row, without border handling: each edge takes a value and registers the sum of the
/// last three.
class SumOfThree final : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> clk{"clk"};
  sc_core::sc_in<std::uint32_t> in_data{"in_data"};
  sc_core::sc_out<std::uint32_t> out_data{"out_data"};

  explicit SumOfThree(const sc_core::sc_module_name& name) : sc_module(name) {
    SC_HAS_PROCESS(SumOfThree);
    SC_METHOD(edge);
    sensitive << clk.pos();
    dont_initialize();
  }

 private:
  void edge() {
    out_data = in_data + last_[0] + last_[1];
    last_ = {in_data, last_[0]};
  }
  std::array<std::uint32_t, 2> last_{};
};

/// Takes a burst of four, one a cycle from the one that `in_valid` begins, and then sends them backwards, one
/// a cycle, as soon as `out_ready` says that there is room for all.
class TurnFour final : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> clk{"clk"}, rst{"rst"}, in_valid{"in_valid"}, out_ready{"out_ready"};
  sc_core::sc_in<std::uint32_t> in_data{"in_data"};
  sc_core::sc_out<bool> in_ready{"in_ready"}, out_valid{"out_valid"};
  sc_core::sc_out<std::uint32_t> out_data{"out_data"};

  explicit TurnFour(const sc_core::sc_module_name& name) : sc_module(name) {
    SC_HAS_PROCESS(TurnFour);
    SC_METHOD(edge);
    sensitive << clk.pos();
    dont_initialize();
    SC_METHOD(pins);
    sensitive << out_ready << changed_;
  }

 private:
  void edge() {
    changed_.notify(sc_core::SC_ZERO_TIME);
    if (rst) return;
    if (fills_) {
      if (in_valid) held_.push_back(in_data);
      fills_ = held_.size() < 4;
    } else if (out_valid) {
      held_.pop_back();
      sends_ = !held_.empty();
      fills_ = held_.empty();
    }
  }
  void pins() {
    in_ready = fills_;
    out_valid = !fills_ && (sends_ || out_ready);
    out_data = held_.empty() ? 0 : held_.back();
  }
  std::deque<std::uint32_t> held_;
  bool fills_ = true, sends_ = false;
  sc_core::sc_event changed_;
};

/// Wires and gates: no clock.
class Complement final : public sc_core::sc_module {
 public:
  sc_core::sc_in<std::uint32_t> in_data{"in_data"};
  sc_core::sc_out<std::uint32_t> out_data{"out_data"};

  explicit Complement(const sc_core::sc_module_name& name) : sc_module(name) {
    SC_HAS_PROCESS(Complement);
    SC_METHOD(gates);
    sensitive << in_data;
  }

 private:
  void gates() { out_data = 255 - in_data; }
};

}  // namespace parallax::test
