// SPDX-License-Identifier: Apache-2.0
#include "platform/config/pipeline_timing.hpp"

#include "platform/config/schema.hpp"

namespace parallax {
namespace {

void describe_stage(Schema& schema, const std::string& stage, const std::string& token, StageTiming& timing) {
  schema.integer(stage + ".interval", timing.interval, {1, 1000}, "core cycles",
                 "Initiation interval: cycles between two " + token + ".",
                 derived("paper, table 1: the published rates leave room for one a cycle only"));
  schema.integer(stage + ".latency", timing.latency, {0, 1000}, "core cycles",
                 "Pipeline depth: cycles from the last input of a result to the result.",
                 inferred("estimate of the registers that the stage's arithmetic needs"));
  schema.integer(stage + ".row_overhead", timing.row_overhead, {0, 1'000'000}, "core cycles",
                 "Cycles lost between two rows.", chosen("not published"));
  schema.integer(stage + ".frame_overhead", timing.frame_overhead, {0, 1'000'000'000}, "core cycles",
                 "Cycles lost between two frames.", chosen("not published"));
}

}  // namespace

void describe(Schema& schema, PipelineTiming& timing) {
  describe_stage(schema, "map_decoder", "map entries", timing.map_decoder);
  describe_stage(schema, "rectification", "pixel pairs", timing.rectification);
  describe_stage(schema, "census", "pixels", timing.census);
  describe_stage(schema, "matching", "iterations; a pixel takes matching.iterations of them",
                 timing.matching);
  describe_stage(schema, "subpixel", "groups of costs", timing.subpixel);
  describe_stage(schema, "uniqueness", "groups of costs", timing.uniqueness);
  describe_stage(schema, "consistency", "groups of costs", timing.consistency);
  describe_stage(schema, "texture", "pixels", timing.texture);
  describe_stage(schema, "speckle", "pixels", timing.speckle);
  describe_stage(schema, "gap_interpolation", "pixels", timing.gap_interpolation);
  describe_stage(schema, "noise_reduction", "pixels", timing.noise_reduction);
}

}  // namespace parallax
