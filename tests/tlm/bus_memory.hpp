// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "tlm/bus_scheduler.hpp"
#include "tlm/memory.hpp"

namespace parallax::test {

/// All parameters of a memory that is a bus.
struct BusMemory : MemoryTargetConfig, BusTiming {};

}  // namespace parallax::test
