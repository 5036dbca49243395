// SPDX-License-Identifier: Apache-2.0
// Keys of the stages that work on the disparity map.
#include "modules/gap_interpolation.hpp"
#include "modules/noise_reduction.hpp"
#include "modules/speckle.hpp"
#include "modules/texture.hpp"
#include "platform/config/schema.hpp"
#include "platform/config/stage_schema.hpp"

namespace parallax {
namespace {

constexpr IntegerRange kDisparitySteps{0, 4094};  // the largest difference of two 12-bit disparities
constexpr const char* kDisparityStep = "1/16 px";

}  // namespace

void describe(Schema& schema, TextureConfig& config) {
  schema.boolean("texture.enabled", config.enabled, "Whether disparities in plain regions are made invalid.",
                 stated(kDeviceSoftware));
  schema.integer(
      "texture.threshold", config.threshold, {0, 63}, "1/32 grey level",
      "Least texture score (t_t): mean contrast of horizontal neighbours in the window.",
      stated("parameters of the device's own software: sensitivity 10 of 63; the unit is our own choice"));
  schema.integer("texture.window", config.window, {3, 15}, "px",
                 "Width and height of the neighbourhood, odd.",
                 chosen("the paper, section Texture Filtering, says local neighborhood"));
}

void describe(Schema& schema, SpeckleConfig& config) {
  schema.integer("speckle.iterations", config.iterations, {0, 4}, "passes",
                 "Passes of the speckle filter; 0 switches it off.", stated(kDeviceSoftware));
  schema.integer("speckle.window", config.window, {3, 31}, "px", "Width and height of the window (w_s), odd.",
                 chosen("the paper, section Speckle Filtering, gives no number"));
  schema.integer("speckle.min_similar_percent", config.min_similar_percent, {0, 100}, "%",
                 "Least share of the window that must be similar to its centre.", chosen("not published"));
  schema.integer("speckle.max_difference", config.max_difference, kDisparitySteps, kDisparityStep,
                 "Disparities are similar when they differ by at most this.", chosen("not published"));
}

void describe(Schema& schema, GapInterpolationConfig& config) {
  schema.boolean("gap_interpolation.enabled", config.enabled,
                 "Whether small gaps are filled from their edges.", stated(kDeviceSoftware));
  schema.integer("gap_interpolation.l_max", config.l_max, {0, 64}, "px",
                 "Longest gap that is filled (l_max).",
                 chosen("the paper, section Gap Interpolation, gives no number"));
  schema.integer("gap_interpolation.max_difference", config.max_difference, kDisparitySteps, kDisparityStep,
                 "The edges of a gap are similar when they differ by at most this.", chosen("not published"));
  schema.choice(
      "gap_interpolation.rounding", config.rounding,
      {{"nearest", InterpolationRounding::kNearest}, {"truncate", InterpolationRounding::kTruncate}},
      "How an interpolated disparity is brought to 1/16 px.", chosen("not published"));
}

void describe(Schema& schema, NoiseReductionConfig& config) {
  schema.boolean("noise_reduction.enabled", config.enabled, "Whether the disparity map is smoothed.",
                 stated(kDeviceSoftware));
  schema.choice("noise_reduction.kind", config.kind,
                {{"mean", NoiseReductionKind::kMean}, {"median", NoiseReductionKind::kMedian}},
                "What a pixel is replaced by: the mean or the median of its similar neighbours.",
                chosen("not published"));
  schema.integer("noise_reduction.window", config.window, {3, 7}, "px",
                 "Width and height of the neighbourhood, odd.", chosen("not published"));
  schema.integer("noise_reduction.max_difference", config.max_difference, kDisparitySteps, kDisparityStep,
                 "Neighbours that differ from the centre by more belong to another surface.",
                 chosen("not published"));
}

}  // namespace parallax
