// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "platform/explore/exploration_spec.hpp"
#include "platform/input/run_options.hpp"

namespace parallax {

/// Options of `parallax run`, without their dashes, that bear on the time of a run, but --set: those that an
/// exploration may give and vary.
std::vector<std::string> timed_run_options();

/// What a command line of these words says. Throws UserError where a value is of the wrong kind, or a flag
/// has one.
RunOptions timed_run(const std::vector<RunWord>& words);

/// The words of such a command line: --size 640x480 and so on.
std::vector<std::string> command_words(const std::vector<RunWord>& words);

}  // namespace parallax
