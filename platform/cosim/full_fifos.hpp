// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tlm/dataflow.hpp"

namespace parallax {

/// The full FIFOs of a closed circle of waits, with depth and who waits for room, "; " between them; empty:
/// there is no circle. Where a circuit stands still they may be what holds it up: it holds back more tokens
/// than the FIFOs past it are deep for.
std::string full_fifos(const Dataflow& dataflow);

}  // namespace parallax
