// SPDX-License-Identifier: Apache-2.0
// What the reference circuits (modules/rtl) take: their registers, memories and DSPs counted from their
// widths, their LUTs by the family's costs. A test holds each against what a synthesiser makes of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "platform/estimate/device_file.hpp"
#include "platform/estimate/resources.hpp"

namespace parallax {

/// A memory of a circuit, and what it is made of.
struct CircuitMemory {
  std::string name;
  Resources resources;
};

/// A circuit: what it takes without its memories, and these.
struct CircuitEstimate {
  Resources logic;
  std::vector<CircuitMemory> memories;

  Resources all() const;
};

/// What all stages have: the size of the image in pixels, and cycles from a firing to its output.
struct StageCircuit {
  int width = 640;
  int height = 480;
  int latency = 4;
  int at_once = 1;  ///< pixels of a row that pass at once: lines are wider and shorter, the arithmetic is
                    ///< there several times. No reference circuit has this
};

struct CensusCircuit {
  StageCircuit stage;
  int window_width = 5;
  int window_height = 5;
};
CircuitEstimate census_circuit(const CensusCircuit& circuit, const DeviceFile& device);

struct RectificationCircuit {
  StageCircuit stage;
  int window = 79;
  int fraction_bits = 5;
  int offset_bits = 12;
};
CircuitEstimate rectification_circuit(const RectificationCircuit& circuit, const DeviceFile& device);

struct MatchingCircuit {
  StageCircuit stage;
  int parallelism = 32;
  int iterations = 4;
  int code_bits = 24;
  int cost_bits = 6;
  int path_bits = 9;
  int sum_bits = 11;
  int window = 0;            ///< disparities of the window of right codes; 0: parallelism * iterations
  int horizontal_paths = 1;  ///< w, e: their predecessor lies in registers
  int line_paths = 3;        ///< those whose predecessor lies in the row above (or below): on chip a row each
  bool lines_on_chip = true;  ///< false: what comes back from outside waits for two pixels
  int rows_at_once = 1;       ///< MatchingConfig::parallel_rows. No reference circuit has this
  bool keeps_row = false;     ///< path e: a row of costs and sums. No reference circuit has this
};
CircuitEstimate matching_circuit(const MatchingCircuit& circuit, const DeviceFile& device);

/// Of the two stages behind the matcher that have a reference.
struct CostCircuit {
  StageCircuit stage;
  int parallelism = 32;
  int iterations = 4;
  int cost_bits = 11;
};
CircuitEstimate subpixel_circuit(const CostCircuit& circuit, const DeviceFile& device);
CircuitEstimate uniqueness_circuit(const CostCircuit& circuit, const DeviceFile& device);

struct NoiseReductionCircuit {
  StageCircuit stage;
  int window = 3;
};
/// Of kind mean.
CircuitEstimate mean_circuit(const NoiseReductionCircuit& circuit, const DeviceFile& device);
/// Of kind median_3x3.
CircuitEstimate median_circuit(const StageCircuit& stage, const DeviceFile& device);

/// Bits that hold the values 0 to `values` - 1: $clog2.
int bits_of(std::int64_t values);

}  // namespace parallax
