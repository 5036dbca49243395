// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "platform/machine/machine.hpp"
#include "platform/results/deadlock_report.hpp"
#include "platform/results/ground_truth.hpp"
#include "traces/metric_table.hpp"

namespace parallax {

/// What was added up over the frames of a run.
struct RunTotals {
  std::int64_t frames = 0;  ///< with images
  std::int64_t pixels = 0;  ///< of the images as given
  std::int64_t valid = 0;   ///< pixels with a disparity
  bool has_truth = false;
  GroundTruthScore score;                   ///< summed over the frames with ground truth
  std::string command;                      ///< that makes the run again
  std::optional<std::uint64_t> scene_seed;  ///< of the built-in scene, when it was the input
  double wall_seconds = 0;
  double peak_megabytes = 0;
};

/// Everything that `timing.json` and the summary say of a run: "schema", "run", "input", "camera",
/// "software", "performance", "latency", "limit", "memory", "energy", "stages", "streams", "buffers",
/// "quality".
MetricGroup measure(const Machine& machine, const RunTotals& totals, int image_width, int image_height);

/// Of a machine that got stuck: "schema", "run", "input", "deadlock", "stages", "streams", "buffers",
/// "quality"; stages and streams until then.
MetricGroup measure_stuck(const Machine& machine, const Deadlock& deadlock, const RunTotals& totals,
                          int image_width, int image_height);

/// "schema", "run", "input", "camera", "software" and "quality".
const MetricTable& run_table();

}  // namespace parallax
