// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <systemc>
#include <vector>

namespace parallax {

/// Calls those who look at a simulation, each again and again after a time of its own, the first time at its
/// begin. A simulation that has come to rest is not kept going by who looks at it: that needs one process for
/// all, as each would take the others for something that is still to come.
class SamplingTimer final : public sc_core::sc_module {
 public:
  explicit SamplingTimer(const sc_core::sc_module_name& name);
  SamplingTimer(const SamplingTimer&) = delete;
  SamplingTimer& operator=(const SamplingTimer&) = delete;

  /// Before the simulation starts.
  void add(const sc_core::sc_time& period, std::function<void()> look) {
    looks_.push_back({period, sc_core::SC_ZERO_TIME, std::move(look)});
  }

 private:
  struct Look {
    sc_core::sc_time period;
    sc_core::sc_time next;
    std::function<void()> look;
  };
  void go_on();

  std::vector<Look> looks_;
};

}  // namespace parallax
