// SPDX-License-Identifier: Apache-2.0
// What circuits have in common.
#pragma once

#include "platform/estimate/reference_circuits.hpp"

namespace parallax {

constexpr int kGreyPixelBits = 8;
constexpr int kDisparityWireBits = 12;
constexpr int kIndexBits = 8;  ///< of a whole disparity

/// Registers of a stage's schedule and handshakes (modules/rtl/stage_control.sv).
std::int64_t control_registers(const StageCircuit& stage, std::int64_t ahead_pixels, int groups = 1);

/// LUTs, rounded. Of the handshakes of a stage's registers, `latency_register` each, and `others`.
std::int64_t stage_luts(const StageCircuit& stage, double others, const DeviceFile& device);

/// Lines of an image, a word a column, or `at_once` columns (modules/rtl/raster_window.sv).
CircuitMemory line_buffer(const std::string& name, const StageCircuit& stage, std::int64_t bits_a_column,
                          const DeviceFile& device);

}  // namespace parallax
