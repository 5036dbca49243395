// SPDX-License-Identifier: Apache-2.0
// The census stage as a circuit with pins, between the streams of the machine.
#pragma once

#include <cstdint>
#include <deque>
#include <systemc>
#include <vector>

#include "modules/census.hpp"
#include "modules/raster_schedule.hpp"
#include "tlm/pin_sink.hpp"
#include "tlm/pin_source.hpp"

namespace parallax {

/// One register behind what the kernel makes of whole rows: it looks a row further ahead than the window.
/// Both images go in together, and both codes come out together.
class CensusCircuit final : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> clk{"clk"}, rst{"rst"};
  sc_core::sc_in<std::uint32_t> left_tdata{"left_tdata"}, right_tdata{"right_tdata"};
  sc_core::sc_in<bool> left_tvalid{"left_tvalid"}, right_tvalid{"right_tvalid"};
  sc_core::sc_out<bool> left_tready{"left_tready"}, right_tready{"right_tready"};
  sc_core::sc_out<std::uint64_t> left_code_tdata{"left_code_tdata"}, right_code_tdata{"right_code_tdata"};
  sc_core::sc_out<bool> left_code_tvalid{"left_code_tvalid"}, right_code_tvalid{"right_code_tvalid"};
  sc_core::sc_in<bool> left_code_tready{"left_code_tready"}, right_code_tready{"right_code_tready"};

  CensusCircuit(const sc_core::sc_module_name& name, const CensusConfig& config, int width, int height)
      : sc_module(name),
        width_(static_cast<std::size_t>(width)),
        frame_(width_ * static_cast<std::size_t>(height)),
        left_(config, width, height),
        right_(config, width, height),
        look_ahead_(width_ * static_cast<std::size_t>(left_.look_ahead_rows() + 1)) {
    SC_HAS_PROCESS(CensusCircuit);
    SC_METHOD(registers);
    sensitive << clk.pos();
    dont_initialize();
    SC_METHOD(handshakes);
    sensitive << left_tvalid << right_tvalid << left_code_tready << right_code_tready << registered_;
  }

  std::uint64_t look_ahead() const { return look_ahead_; }  ///< pixels

 private:
  bool reads() const { return pixel_ < frame_; }
  bool writes() const { return pixel_ >= look_ahead_; }
  bool may_fire() const { return !writes() || !full_ || (left_code_tready && right_code_tready); }

  void handshakes() {
    left_tready = may_fire() && reads() && right_tvalid;
    right_tready = may_fire() && reads() && left_tvalid;
    left_code_tvalid = full_ && right_code_tready;
    right_code_tvalid = full_ && left_code_tready;
  }

  void registers() {
    registered_.notify(sc_core::SC_ZERO_TIME);
    if (rst) return;
    const bool fires = may_fire() && (!reads() || (left_tvalid && right_tvalid));
    if (left_code_tready && right_code_tready) full_ = false;
    if (!fires) return;
    if (reads()) take();
    if (writes()) {
      full_ = true;
      left_code_tdata = left_codes_.front();
      right_code_tdata = right_codes_.front();
      left_codes_.pop_front();
      right_codes_.pop_front();
    }
    pixel_ = pixel_ + 1 == frame_ + look_ahead_ ? 0 : pixel_ + 1;
  }

  void take() {
    left_row_.push_back(static_cast<Gray>(left_tdata));
    right_row_.push_back(static_cast<Gray>(right_tdata));
    if (left_row_.size() < width_) return;
    const auto keep = [this](std::deque<CensusCode>& codes) {
      return [this, &codes](const CensusCode* row) { codes.insert(codes.end(), row, row + width_); };
    };
    left_.push(left_row_.data(), keep(left_codes_));
    right_.push(right_row_.data(), keep(right_codes_));
    left_row_.clear();
    right_row_.clear();
  }

  const std::size_t width_;
  const std::uint64_t frame_;  // pixels
  Census left_, right_;
  const std::uint64_t look_ahead_;
  std::uint64_t pixel_ = 0;  // firings of this frame
  bool full_ = false;        // the register of the codes
  std::vector<Gray> left_row_, right_row_;
  std::deque<CensusCode> left_codes_, right_codes_;
  sc_core::sc_event registered_;
};

/// The circuit in the place of the stage: the stage's ports, and an end at the pins for each.
class CensusAtPins final : public sc_core::sc_module {
 public:
  StreamIn<Gray> in_left{"in_left"};
  StreamIn<Gray> in_right{"in_right"};
  StreamOut<CensusCode> out_left{"out_left"};
  StreamOut<CensusCode> out_right{"out_right"};

  /// `frames`: those with images; the cameras go on behind them.
  CensusAtPins(const sc_core::sc_module_name& name, const CensusConfig& config, const StageContext& context,
               std::uint64_t frames)
      : sc_module(name),
        config_(with_images(context.tokens() * frames)),
        clock_("clock", context.clock),
        circuit_("circuit", config, context.width, context.height) {
    clock_.clock(clk_);
    clock_.reset(rst_);
    circuit_.clk(clk_);
    circuit_.rst(rst_);

    left_.in(in_left);
    left_.bind(left_pins_);
    circuit_.left_tdata(left_pins_.data);
    circuit_.left_tvalid(left_pins_.valid);
    circuit_.left_tready(left_pins_.ready);

    right_.in(in_right);
    right_.bind(right_pins_);
    circuit_.right_tdata(right_pins_.data);
    circuit_.right_tvalid(right_pins_.valid);
    circuit_.right_tready(right_pins_.ready);

    left_code_.out(out_left);
    left_code_.bind(left_code_pins_);
    circuit_.left_code_tdata(left_code_pins_.data);
    circuit_.left_code_tvalid(left_code_pins_.valid);
    circuit_.left_code_tready(left_code_pins_.ready);

    right_code_.out(out_right);
    right_code_.bind(right_code_pins_);
    circuit_.right_code_tdata(right_code_pins_.data);
    circuit_.right_code_tvalid(right_code_pins_.valid);
    circuit_.right_code_tready(right_code_pins_.ready);
  }

  // How deep the FIFOs beside it must be follows from these.
  std::uint64_t look_ahead() const { return circuit_.look_ahead(); }
  std::uint64_t latency() const { return 1; }

 private:
  static PinConfig with_images(std::uint64_t tokens) {
    PinConfig config;
    config.with_values = tokens;
    return config;
  }

  const PinConfig config_;
  sc_core::sc_signal<bool> clk_, rst_;
  PinSignals<std::uint32_t> left_pins_, right_pins_;
  PinSignals<std::uint64_t> left_code_pins_, right_code_pins_;
  PinClock clock_;
  PinSource<Gray, std::uint32_t> left_{"left", clock_, config_}, right_{"right", clock_, config_};
  PinSink<CensusCode, std::uint64_t> left_code_{"left_code", clock_, config_};
  PinSink<CensusCode, std::uint64_t> right_code_{"right_code", clock_, config_};
  CensusCircuit circuit_;
};

}  // namespace parallax
