// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/run_folder.hpp"

#include <fmt/format.h>

#include "platform/input/image_pairs.hpp"
#include "platform/results/truth_array.hpp"

namespace parallax {
namespace {

std::vector<NamedInput> inputs_of(const RunOptions& options) {
  std::vector<NamedInput> inputs;
  const auto add = [&inputs](const char* option, const std::string& path) {
    if (!path.empty()) inputs.push_back({fmt::format("{} {}", option, path), path});
  };
  add("--left", options.left);
  add("--right", options.right);
  add("--ground-truth", truth_path(options.ground_truth).file);
  add("--mask", options.mask);
  add("--map", options.map);
  add("--input", options.input);
  add("--preset", options.configuration.preset);
  for (const std::string& path : options.calibration) add("--calibration", path);
  if (options.input.empty()) return inputs;
  for (const ImagePair& pair : find_image_pairs(options.input)) {
    for (const auto& path : {pair.left, pair.right})
      inputs.push_back({fmt::format("{} of --input {}", path.string(), options.input), path});
  }
  return inputs;
}

}  // namespace

FolderPlan folder_plan(const RunOptions& options, const ResultPlan& results) {
  return {[results](const std::string& name) { return is_planned(results, name); }, is_result_name,
          inputs_of(options)};
}

}  // namespace parallax
