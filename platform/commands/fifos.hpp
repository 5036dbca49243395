// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "platform/input/run_options.hpp"

namespace parallax {

struct CommandContext;

/// What the user asked `parallax fifos` for.
struct FifosOptions {
  RunOptions run;                   ///< machine and input; --out, --json
  std::string goal = "full-rate";   ///< or "deadlock-free"
  std::optional<double> rate;       ///< frames/s, another goal
  bool front = false;               ///< points between fast and small, too
  std::optional<double> tolerance;  ///< % of a frame, of full-rate; none: kUsualTolerance

  /// Less than the last digit of a rate that is printed; the phases of the memory move it by a third of that.
  static constexpr double kUsualTolerance = 0.001;
};

/// The smallest depths of the pipeline's FIFOs with which the machine reaches a goal (FifoSizer), as a table
/// or JSON; with --out fifos.json, and depths.toml, the machine with these depths as a preset. Returns 0; 1
/// when the goal cannot be reached; 128 + the signal when interrupted.
int fifos(const FifosOptions& options, CommandContext& context);

}  // namespace parallax
