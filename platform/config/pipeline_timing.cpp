// SPDX-License-Identifier: Apache-2.0
#include "platform/config/pipeline_timing.hpp"

#include "platform/config/schema.hpp"

namespace parallax {

void describe_timing(Schema& schema, const std::string& stage, const std::string& token,
                     LooksAhead looks_ahead, StageTiming& timing) {
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
  if (looks_ahead == LooksAhead::kNo) return;
  schema.choice(
      stage + ".overlap_frames", timing.overlap,
      {{"as_pipeline", FrameOverlap::kAsPipeline}, {"no", FrameOverlap::kNo}, {"yes", FrameOverlap::kYes}},
      "Whether the next frame comes in while the last rows of the one before go out; or as "
      "pipeline.overlap_frames says.",
      chosen("one key for all stages"));
}

void describe(Schema& schema, PipelineTiming& timing) {
  schema.integer(
      "pipeline.pixels_per_token", timing.pixels_per_token, {1, 16}, "px",
      "Neighbours of a row that pass each stage at once, as one token; widths must be multiples. The "
      "matcher takes a token's pixels one after the other, unless it has matching.parallel_rows.",
      derived("paper, table 1: one pixel passes at a time"));
  schema.boolean(
      "pipeline.overlap_frames", timing.overlap_frames,
      "Whether stages that look ahead take the next frame in while the last rows of the one before go "
      "out, so that nothing is lost between frames. What a second pass over the image needs, or path "
      "costs in memory with path e, is emptied first all the same. Shows where frames queue in the core "
      "(software.queue_frames).",
      chosen("not published; emptying the line buffers first is the simpler circuit"));
  describe_timing(schema, "map_decoder", "map entries", LooksAhead::kNo, timing.map_decoder);
  describe_timing(schema, "rectification", "pixel pairs", LooksAhead::kYes, timing.rectification);
  describe_timing(schema, "census", "pixels", LooksAhead::kYes, timing.census);
  describe_timing(schema, "matching", "iterations; a pixel takes matching.iterations of them",
                  LooksAhead::kYes, timing.matching);
  describe_timing(schema, "subpixel", "groups of costs", LooksAhead::kNo, timing.subpixel);
  describe_timing(schema, "uniqueness", "groups of costs", LooksAhead::kNo, timing.uniqueness);
  describe_timing(schema, "consistency", "groups of costs", LooksAhead::kYes, timing.consistency);
  describe_timing(schema, "texture", "pixels", LooksAhead::kYes, timing.texture);
}

}  // namespace parallax
