// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "platform/cosim/vector_manifest.hpp"

namespace parallax {

/// SystemVerilog: a test bench that feeds a circuit with the vectors of a stage, takes its results under
/// random stalls on both sides, short and long ones, and compares them. It says the same in Icarus Verilog
/// and Verilator.
std::string test_bench(const VectorManifest& manifest);

}  // namespace parallax
