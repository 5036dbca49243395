// SPDX-License-Identifier: Apache-2.0
#include "platform/config/stage_schema.hpp"

#include "modules/census.hpp"
#include "modules/consistency.hpp"
#include "modules/gap_interpolation.hpp"
#include "modules/matching.hpp"
#include "modules/noise_reduction.hpp"
#include "modules/rectification.hpp"
#include "modules/speckle.hpp"
#include "modules/subpixel.hpp"
#include "modules/texture.hpp"
#include "modules/uniqueness.hpp"
#include "platform/config/schema.hpp"

namespace parallax {
namespace {

constexpr IntegerRange kDisparitySteps{0, 4094};  // the largest difference of two 12-bit disparities
constexpr const char* kDisparityStep = "1/16 px";

}  // namespace

void describe(Schema& schema, RectificationConfig& config) {
  using Rounding = RectificationConfig::Rounding;
  schema.integer(
      "rectification.window", config.range.window, {1, 2047}, "px",
      "Rows and columns that rectification can reach, odd; offsets of (window - 1) / 2 each way. It costs "
      "this many rows of storage per image.",
      stated("paper, section Rectification: 79 x 79"));
  schema.integer("rectification.fraction_bits", config.range.fraction_bits, {0, 8}, "bit",
                 "Fraction bits of an offset of the rectification map.",
                 chosen("5 as in OpenCV's remap; the paper says subpixel accurate"));
  schema.choice("rectification.rounding", config.rounding,
                {{"nearest", Rounding::kNearest}, {"truncate", Rounding::kTruncate}},
                "How the interpolated intensity is brought to 8 bits.", chosen("as in OpenCV's remap"));
}

void describe(Schema& schema, CensusConfig& config) {
  const Provenance window = inferred("a device image has a masked border of 2 px: a window of 5 x 5");
  schema.boolean("census.enabled", config.enabled,
                 "Whether pixels are matched by their census codes; otherwise by their grey values, which "
                 "pass the stage with its latency and no look-ahead (matching.cost).",
                 inferred("the paper, section Image Pre-Processing, says more robust towards illumination "
                          "variations"));
  schema.integer("census.window_width", config.window_width, {1, 63}, "px",
                 "Width of the census window, odd. The window has at most 63 neighbours.", window);
  schema.integer("census.window_height", config.window_height, {1, 63}, "px",
                 "Height of the census window, odd. The window has at most 63 neighbours.", window);
  schema.choice(
      "census.bit_order", config.bit_order,
      {{"msb_first", CensusBitOrder::kMsbFirst}, {"lsb_first", CensusBitOrder::kLsbFirst}},
      "Place of the top left neighbour in the code; the others follow in raster order. It does not change "
      "the disparities.",
      chosen("not published"));
  schema.choice("census.comparison", config.comparison,
                {{"less", CensusComparison::kLess},
                 {"less_equal", CensusComparison::kLessEqual},
                 {"greater", CensusComparison::kGreater},
                 {"greater_equal", CensusComparison::kGreaterEqual}},
                "How a neighbour compares with the centre when its bit is 1.", chosen("not published"));
  schema.choice(
      "census.border", config.border,
      {{"replicate", CensusBorder::kReplicate},
       {"zero", CensusBorder::kZero},
       {"mask", CensusBorder::kMask},
       {"delay_line", CensusBorder::kDelayLine}},
      "What the window sees outside the image: the nearest pixel, the value 0, nothing (the whole code is "
      "0), "
      "or, as in a delay line without border handling, the pixel that lies there in raster order, and 0 "
      "before the first and behind the last.",
      chosen("not published"));
}

void describe(Schema& schema, MatchingConfig& config) {
  schema.integer(
      "matching.parallel_rows", config.parallel_rows, {1, 64}, "rows",
      "Rows of the image that the matcher works on at once, each with matching.parallelism comparisons "
      "in an iteration. Rows wait for their turn in its line buffers.",
      derived("paper, section Stereo Matching: p comparisons in parallel, of one pixel"));
  schema.integer("matching.parallelism", config.parallelism, {1, 256}, "disparities",
                 "Disparities that one iteration compares (p).",
                 stated("paper, section Stereo Matching: p = 32"));
  schema.integer("matching.iterations", config.iterations, {1, 256}, "iterations",
                 "Iterations per pixel (n_i); the range is iterations x parallelism disparities.",
                 derived("paper, table 1: 128 disparities at p = 32"));
  schema.integer(
      "matching.recurrence_latency", config.recurrence_latency, {1, 1000}, "core cycles",
      "Cycles until the minimum over all disparities of a pixel is there, which the next pixel needs: from "
      "the start of its last iteration, or, with matching.recurrence_order = minimum_first, of its first "
      "one.",
      derived("paper, table 1: more than one cycle would need a faster clock than such fabric has"));
  schema.choice(
      "matching.recurrence_order", config.recurrence_order,
      {{"plain", RecurrenceOrder::kPlain}, {"minimum_first", RecurrenceOrder::kMinimumFirst}},
      "When a pixel's minimum over all disparities is taken: after the update of its costs, so that a pixel "
      "takes (iterations - 1) * interval + recurrence_latency cycles; or from what goes into the update, so "
      "that it takes recurrence_latency; in both cases iterations * interval if that is more.",
      chosen("not published; a recurrence_latency of 1 is hidden in either order"));
  schema.integer("matching.disparity_offset", config.disparity_offset, {0, 255}, "px",
                 "Smallest disparity (o_d); offset and range together are at most 256.",
                 stated(kDeviceSoftware));
  schema.choice(
      "matching.cost", config.cost,
      {{"hamming", MatchingCost::kHamming}, {"absolute_difference", MatchingCost::kAbsoluteDifference}},
      "Cost of two pixels: the number of bits in which their census codes differ, or, with "
      "census.enabled = false, the absolute difference of their grey values.",
      inferred("as the census transform"));
  schema.integer(
      "matching.cost_weight", config.cost_weight, {1, 4}, "units",
      "Cost of one differing census bit, in the unit of the penalties matching.p1 and matching.p2; "
      "differences of grey values have no weight.",
      chosen("the penalties of the device are known, their unit is not"));
  schema.integer("matching.p1", config.p1, {0, 255}, "units",
                 "Penalty for a disparity change of one along a path; below matching.p2.",
                 stated(kDeviceSoftware));
  schema.integer("matching.p2", config.p2, {0, 255}, "units",
                 "Penalty for a larger disparity change along a path.", stated(kDeviceSoftware));
  schema.name_set(
      "matching.paths", config.paths,
      {{"w", kPathW},
       {"nw", kPathNW},
       {"n", kPathN},
       {"ne", kPathNE},
       {"e", kPathE},
       {"sw", kPathSW},
       {"s", kPathS},
       {"se", kPathSE}},
      "Paths whose costs are summed, each named for where the predecessor of a pixel lies. e holds a row of "
      "costs; sw, s and se need a second pass over the image, and memory traffic through the ports "
      "buffer_frame_write and buffer_frame_read.",
      inferred("the paths that need one pass over the image"));
  schema.choice(
      "matching.path_storage", config.path_storage,
      {{"on_chip", PathStorage::kOnChip}, {"memory", PathStorage::kMemory}},
      "Where the path costs of the previous row lie: on chip, or in memory, written and read back "
      "through the ports buffer_row_write and buffer_row_read.",
      inferred("a row of them, some 2.2 Mbit with 128 disparities at 640 columns, fits on chip; what the "
               "device's buffer port is for is not published"));
  schema.choice("matching.outside_cost", config.outside_cost,
                {{"maximum", OutsideCost::kMaximum},
                 {"replicate", OutsideCost::kReplicate},
                 {"zero_code", OutsideCost::kZeroCode},
                 {"delay_line", OutsideCost::kDelayLine},
                 {"value", OutsideCost::kValue}},
                "Cost of a right pixel left of the image: the largest there is (all bits differ, or 255), as "
                "the first pixel of the row, as a pixel with code (or grey value) 0, as the pixel that lies "
                "there in raster order, in a row above, or the value matching.outside_value.",
                chosen("not published"));
  schema.integer("matching.outside_value", config.outside_value, {0, 255}, "units",
                 "That cost with matching.outside_cost = value, whatever matching.cost_weight is.",
                 chosen("as dear as any cost"));
  schema.choice(
      "matching.path_start", config.path_start,
      {{"cost", PathStart::kCost},
       {"clamp", PathStart::kClamp},
       {"carry", PathStart::kCarry},
       {"delay_line", PathStart::kDelayLine},
       {"first_column", PathStart::kFirstColumn}},
      "Predecessor of a pixel whose path begins outside the image: none; for diagonal paths the pixel "
      "straight above or below; for path w the last pixel of the row above; or the pixel before in raster "
      "order, as in a plain delay line; or that, but in the first column all paths start anew.",
      chosen("not published"));
  schema.integer("matching.path_bits", config.path_bits, {0, 16}, "bit",
                 "Bits of a path cost in line buffers and sums; 0: as many as the largest one needs.",
                 chosen("not published"));
  schema.choice(
      "matching.path_overflow", config.path_overflow,
      {{"saturate", PathOverflow::kSaturate}, {"wrap", PathOverflow::kWrap}},
      "What becomes of a path cost that does not fit in matching.path_bits: the largest value, or its "
      "lower bits.",
      chosen("not published"));
  schema.integer("matching.sum_shift", config.sum_shift, {0, 11}, "bit",
                 "Lowest bits of a sum of path costs that are left out.", chosen("not published"));
}

void describe(Schema& schema, SubpixelConfig& config) {
  schema.choice("subpixel.curve", config.curve,
                {{"none", SubpixelCurve::kNone},
                 {"parabola", SubpixelCurve::kParabola},
                 {"equiangular", SubpixelCurve::kEquiangular}},
                "Curve through the costs at the minimum and beside it; none gives whole disparities.",
                chosen("the paper, section Subpixel Optimization, does not name the curve"));
  schema.choice("subpixel.rounding", config.rounding,
                {{"truncate", SubpixelRounding::kTruncate}, {"nearest", SubpixelRounding::kNearest}},
                "How the distance from the whole disparity is brought to 1/16 px: toward zero, or to the "
                "nearest, halves "
                "away from zero, and to 8/16 only where the cost on that side is as low as the winner's.",
                chosen("not published"));
  schema.choice("subpixel.winner", config.winner,
                {{"lowest", TieRule::kLowest}, {"highest", TieRule::kHighest}},
                "Which of several equally cheap disparities wins.", chosen("not published"));
  schema.boolean("subpixel.mask_border", config.mask_border,
                 "Whether pixels at the image border are made invalid.", stated(kDeviceSoftware));
  const Provenance border = stated("an image of the device has a masked border of 2 px");
  schema.integer("subpixel.border_width", config.border_width, {0, 31}, "px",
                 "Masked columns on the left and right.", border);
  schema.integer("subpixel.border_height", config.border_height, {0, 31}, "px",
                 "Masked rows at top and bottom.", border);
}

void describe(Schema& schema, UniquenessConfig& config) {
  schema.boolean("uniqueness.enabled", config.enabled, "Whether ambiguous matches are made invalid.",
                 stated(kDeviceSoftware));
  schema.integer("uniqueness.factor", config.factor, {256, 4096}, "1/256",
                 "Uniqueness factor (q): the lowest cost times q must be below the next best one.",
                 chosen("how the device's sensitivity, 65 of 256 by default, maps to q is not published; "
                        "chosen on pairs with ground truth"));
  schema.boolean("uniqueness.neighbours_are_rivals", config.neighbours_are_rivals,
                 "Whether the two disparities beside the best one count as the next best.",
                 chosen("they belong to the same minimum"));
}

void describe(Schema& schema, ConsistencyConfig& config) {
  schema.boolean("consistency.enabled", config.enabled,
                 "Whether matches that the right image's disparities do not confirm are made invalid.",
                 stated(kDeviceSoftware));
  schema.integer("consistency.threshold", config.threshold, {0, 15}, "px",
                 "Largest difference between left and right disparity (t_c).",
                 inferred("the device's default sensitivity 13 of 15, taken as 15 - t_c"));
  schema.choice("consistency.right_winner", config.right_winner,
                {{"lowest", TieRule::kLowest}, {"highest", TieRule::kHighest}},
                "Which of several equally cheap disparities of a right pixel wins.", chosen("not published"));
  schema.choice("consistency.outside_match", config.outside_match,
                {{"keep", OutsideMatch::kKeep}, {"invalidate", OutsideMatch::kInvalidate}},
                "What becomes of a match left of the right image, where nothing could confirm it.",
                chosen("not published"));
}

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
  schema.choice(
      "noise_reduction.kind", config.kind,
      {{"mean", NoiseReductionKind::kMean},
       {"median", NoiseReductionKind::kMedian},
       {"median_3x3", NoiseReductionKind::kMedian3x3},
       {"median_5x5", NoiseReductionKind::kMedian5x5}},
      "What a pixel is replaced by: the mean or the median of its similar neighbours, or the median of "
      "all disparities around it, invalid ones being the largest; then without "
      "noise_reduction.window and noise_reduction.max_difference.",
      chosen("not published"));
  schema.integer("noise_reduction.window", config.window, {3, 7}, "px",
                 "Width and height of the neighbourhood, odd.", chosen("not published"));
  schema.integer("noise_reduction.max_difference", config.max_difference, kDisparitySteps, kDisparityStep,
                 "Neighbours that differ from the centre by more belong to another surface.",
                 chosen("not published"));
}

}  // namespace parallax
