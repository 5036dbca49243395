// SPDX-License-Identifier: Apache-2.0
// modules/rtl/census.sv, as `verilator --sc` makes a SystemC module of it, in the place of the stage.
#pragma once

#include <PinCensus.h>  // made by Verilator

#include "modules/pixel.hpp"
#include "modules/raster_schedule.hpp"
#include "tlm/axi_stream_checker.hpp"
#include "tlm/pin_sink.hpp"
#include "tlm/pin_source.hpp"

namespace parallax::test {

class VerilatedCensus final : public sc_core::sc_module {
 public:
  StreamIn<Gray> in_left{"in_left"};
  StreamIn<Gray> in_right{"in_right"};
  StreamOut<CensusCode> out_left{"out_left"};
  StreamOut<CensusCode> out_right{"out_right"};

  VerilatedCensus(const sc_core::sc_module_name& name, const StageContext& context, std::uint64_t latency,
                  std::uint64_t look_ahead)
      : sc_module(name), clock_("clock", context.clock), latency_(latency), look_ahead_(look_ahead) {
    clock_.clock(clk_);
    clock_.reset(rst_);
    circuit_.clk(clk_);
    circuit_.rst(rst_);

    left_.in(in_left);
    left_.bind(left_pins_);
    circuit_.in_left_data(left_pins_.data);
    circuit_.in_left_valid(left_pins_.valid);
    circuit_.in_left_ready(left_pins_.ready);
    circuit_.in_left_first(unused_);
    circuit_.in_left_last(unused_);

    right_.in(in_right);
    right_.bind(right_pins_);
    circuit_.in_right_data(right_pins_.data);
    circuit_.in_right_valid(right_pins_.valid);
    circuit_.in_right_ready(right_pins_.ready);
    circuit_.in_right_first(unused_);
    circuit_.in_right_last(unused_);

    left_code_.out(out_left);
    left_code_.bind(left_code_pins_);
    circuit_.out_left_data(left_code_pins_.data);
    circuit_.out_left_valid(left_code_pins_.valid);
    circuit_.out_left_ready(left_code_pins_.ready);

    right_code_.out(out_right);
    right_code_.bind(right_code_pins_);
    circuit_.out_right_data(right_code_pins_.data);
    circuit_.out_right_valid(right_code_pins_.valid);
    circuit_.out_right_ready(right_code_pins_.ready);

    checker_.clock(clk_);
    checker_.reset(rst_);
    checker_.valid(left_pins_.valid);
    checker_.ready(left_pins_.ready);
    checker_.data(left_pins_.data);
  }

  std::uint64_t latency() const { return latency_; }
  std::uint64_t look_ahead() const { return look_ahead_; }

 private:
  sc_core::sc_signal<bool> clk_, rst_, unused_;
  PinSignals<std::uint32_t> left_pins_, right_pins_, left_code_pins_, right_code_pins_;
  PinClock clock_;
  PinSource<Gray, std::uint32_t> left_{"left", clock_}, right_{"right", clock_};
  PinSink<CensusCode, std::uint32_t> left_code_{"left_code", clock_}, right_code_{"right_code", clock_};
  AxiStreamChecker<std::uint32_t> checker_{"checker", clock_.domain()};
  PinCensus circuit_{"circuit"};
  const std::uint64_t latency_, look_ahead_;
};

}  // namespace parallax::test
