// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "tlm/bus_scheduler.hpp"
#include "tlm/memory.hpp"

namespace parallax::test {

/// All parameters of a memory that is a bus.
struct BusMemory : MemoryTargetConfig, BusTiming {};

class BusMemoryTarget : public Memory {
 public:
  BusMemoryTarget(const sc_core::sc_module_name& name, const BusMemory& config, const ClockDomain& clock)
      : Memory(name, config, std::make_unique<BusScheduler>(config, clock)) {}
};

}  // namespace parallax::test
