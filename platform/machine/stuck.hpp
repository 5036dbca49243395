// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace parallax {

class Machine;

/// Where chains of waits end in a machine in which nothing moves, a line each: memory requests without an
/// answer (port, address, date), and tokens that a block does not read or write, which waits for none itself
/// (block, stream, token with its frame and row, since which cycle). A block in kernel time is said to be
/// one. Empty: no chain ends.
std::string describe_ends(const Machine& machine);

}  // namespace parallax
