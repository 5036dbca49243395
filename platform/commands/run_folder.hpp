// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/input/run_options.hpp"
#include "platform/results/output_folder.hpp"
#include "platform/results/result_names.hpp"

namespace parallax {

/// What a run does to its folder: writes what is planned, replaces results of earlier runs, and reads what
/// the options name. Throws UserError when a list of pairs cannot be read.
FolderPlan folder_plan(const RunOptions& options, const ResultPlan& results);

}  // namespace parallax
