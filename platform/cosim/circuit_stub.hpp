// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "platform/cosim/vector_manifest.hpp"

namespace parallax {

/// SystemVerilog: the port list that a stage's test bench expects, with no circuit behind it.
std::string circuit_stub(const VectorManifest& manifest);

/// The range of the bus that carries a token of the stream, such as "[11:0]".
std::string bus_range(const VectorStream& stream);

}  // namespace parallax
