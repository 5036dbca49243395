// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "platform/cosim/dump_file.hpp"

namespace parallax {

/// The tokens of a stream in the waves of a simulation: at each rising edge of the clock, what lies on the
/// data wires just before it, if valid is 1, and ready is 1 or not there. Cycles count rising edges from 0
/// on. Throws UserError when the text is damaged, a signal is not in it or in it twice, valid or ready is
/// unknown behind the first token, or there is no token.
Dump tokens_of_vcd(const std::string& text, const std::string& path, const VectorStream& stream,
                   const DumpSignals& signals);

}  // namespace parallax
