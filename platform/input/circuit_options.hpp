// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace parallax {

/// CircuitOptions::waves, if not given.
constexpr std::uint64_t kCircuitWaves = 64;

/// What the user said of a circuit in the place of a stage.
struct CircuitOptions {
  std::string circuit;                  ///< STAGE=FILE[,FILE...]: a library, or Verilog
  std::string top;                      ///< the top module; empty: the only one
  std::vector<std::string> parameters;  ///< NAME=VALUE, of Verilog
  std::vector<std::string> includes;    ///< folders in which `include and modules are looked for
  std::vector<std::string> defines;     ///< NAME or NAME=VALUE, of the preprocessor
  std::vector<std::string> pins;        ///< ROLE=PIN: "in_left.data=pixel", "clock=clk_i"
  std::vector<std::string> constants;   ///< PIN=VALUE: inputs that stay as they are
  std::uint64_t interval = 1;           ///< least cycles from one token to the next at an input, >= 1
  std::uint64_t row_gap = 0;            ///< least edges without a token behind each row, at an input
  std::uint64_t frame_gap = 0;          ///< likewise behind each frame, or tile, and the zeros behind it
  std::uint64_t latency = 0;            ///< edges from a token to its result, of a circuit without valid
  std::optional<std::uint64_t> flush;   ///< tokens of zeros behind each frame; none: `latency`
  std::uint64_t skip = 0;               ///< outputs before a frame's first token that count for nothing
  std::uint64_t stall = 0;              ///< of 1000 cycles, those in which a side is stalled, at random
  std::uint64_t seed = 1;               ///< of the stalls, and of registers without an initial value
  /// Cycles in which some token must pass while one is due, >= 1; none: 100000, or four for each token of a
  /// frame.
  std::optional<std::uint64_t> timeout;
  /// Cycles before the first difference, and as many behind, of which waves are written; none: kCircuitWaves.
  std::optional<std::uint64_t> waves;
  std::uint64_t seconds = 60;         ///< wall-clock time that one evaluation may take, >= 1
  std::optional<std::int64_t> bound;  ///< cycles by which a token may be later than the model's
};

}  // namespace parallax
