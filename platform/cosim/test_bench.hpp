// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "platform/cosim/vector_manifest.hpp"

namespace parallax {

/// SystemVerilog: a test bench that feeds a circuit with the vectors of a stage, takes its results under
/// random stalls on both sides, and compares them. It says the same in Icarus Verilog and Verilator.
std::string test_bench(const VectorManifest& manifest);

/// SystemVerilog: the port list that the test bench expects, with no circuit behind it.
std::string circuit_stub(const VectorManifest& manifest);

}  // namespace parallax
