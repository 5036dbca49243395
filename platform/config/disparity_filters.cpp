// SPDX-License-Identifier: Apache-2.0
#include "platform/config/disparity_filters.hpp"

#include "modules/gap_interpolation.hpp"
#include "modules/noise_reduction.hpp"
#include "modules/speckle.hpp"
#include "platform/config/filter_of.hpp"
#include "platform/config/stage_schema.hpp"

namespace parallax {

DisparityFilters disparity_filters() {
  DisparityFilters filters;
  filters.add(shared_filter<Speckle, SpeckleConfig>(
      "speckle", "despeckled", {&MachineConfig::speckle, &PipelineTiming::speckle},
      [](const SpeckleConfig& config) { return config.iterations > 0; }));
  filters.add(shared_filter<GapInterpolation, GapInterpolationConfig>(
      "gap_interpolation", "interpolated",
      {&MachineConfig::gap_interpolation, &PipelineTiming::gap_interpolation},
      [](const GapInterpolationConfig& config) { return config.enabled; }));
  filters.add(shared_filter<NoiseReduction, NoiseReductionConfig>(
      "noise_reduction", "smoothed", {&MachineConfig::noise_reduction, &PipelineTiming::noise_reduction},
      [](const NoiseReductionConfig& config) { return config.enabled; }));
  return filters;
}

}  // namespace parallax
