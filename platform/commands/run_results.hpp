// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "platform/commands/run_frames.hpp"
#include "platform/config/configuration.hpp"
#include "platform/input/run_options.hpp"
#include "platform/results/output_folder.hpp"
#include "platform/tracing/run_profile.hpp"
#include "traces/metrics.hpp"

namespace parallax {

struct CommandContext;

/// What a run says when it is over: timing.json and what belongs beside it, and the summary.
class RunResults {
 public:
  /// `folder`: null, if nothing is to be written.
  RunResults(const RunOptions& options, const Configuration& configuration, CommandContext& context,
             OutputFolder* folder)
      : options_(options), configuration_(configuration), context_(context), folder_(folder) {}

  /// timing.json, which it returns, and profile.json, with all files that wait to be published; then
  /// report.html of these.
  nlohmann::ordered_json write(const MetricGroup& metrics, const RunProfile* profile,
                               RunFrames& frames) const;
  /// On standard output: the tree, or the summary.
  void print(const MetricGroup& metrics, const nlohmann::ordered_json& tree) const;

 private:
  const RunOptions& options_;
  const Configuration& configuration_;
  CommandContext& context_;
  OutputFolder* const folder_;
};

}  // namespace parallax
