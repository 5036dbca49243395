// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "tlm/units.hpp"

namespace parallax {

/// When a firing starts, given the cycle `free` from which on its stage can fire again, the one in which the
/// last of its inputs has a token, and the one in which there is room for what it writes.
struct FiringStart {
  FiringStart(Cycles free, Cycles inputs, Cycles room)
      : ready(std::max(free, inputs)), start(std::max(ready, room)) {}

  Cycles ready;  ///< from `free` on it was held back by its inputs,
  Cycles start;  ///< and from there on by what it writes
};

/// When a firing leaves the pipeline that started in cycle `start`, given when the one before it left and the
/// cycle in which all its outputs have room.
struct FiringEnd {
  FiringEnd(Cycles start, std::uint32_t latency, Cycles before, Cycles room)
      : wanted(std::max(start + Cycles(latency), before + Cycles(1))), left(std::max(wanted, room)) {}

  Cycles wanted;  ///< from there on it was held back by its outputs
  Cycles left;
};

}  // namespace parallax
