// SPDX-License-Identifier: Apache-2.0
#include "platform/config/pipeline_timing.hpp"

#include "platform/config/schema.hpp"

namespace parallax {

void describe_timing(Schema& schema, const std::string& stage, const std::string& token,
                     StageTiming& timing) {
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

void describe(Schema& schema, PipelineTiming& timing) {
  describe_timing(schema, "map_decoder", "map entries", timing.map_decoder);
  describe_timing(schema, "rectification", "pixel pairs", timing.rectification);
  describe_timing(schema, "census", "pixels", timing.census);
  describe_timing(schema, "matching", "iterations; a pixel takes matching.iterations of them",
                  timing.matching);
  describe_timing(schema, "subpixel", "groups of costs", timing.subpixel);
  describe_timing(schema, "uniqueness", "groups of costs", timing.uniqueness);
  describe_timing(schema, "consistency", "groups of costs", timing.consistency);
  describe_timing(schema, "texture", "pixels", timing.texture);
}

}  // namespace parallax
