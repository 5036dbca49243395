// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/input/run_options.hpp"

namespace CLI {
class App;
}

namespace parallax {

/// Which images go into the machine, and how they are rectified: --left, --right, --input, --frames, --size,
/// --seed, --rectified, --image-bits, --calibration, --cameras, --map, --fit. `options` must outlive the
/// command.
void add_input_options(CLI::App& command, RunOptions& options);

/// --timing-frames.
void add_timing_frames_option(CLI::App& command, RunOptions& options);

}  // namespace parallax
