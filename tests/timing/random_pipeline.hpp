// SPDX-License-Identifier: Apache-2.0
// Small machines with random paces, latencies, windows, depths, kinds of FIFO, bursts and maps.
#pragma once

#include <rapidcheck.h>

#include "tests/modules/random_maps.hpp"
#include "tests/timing/pipeline_simulation.hpp"

namespace parallax::test {

enum class Depths { kAutomatic, kRandom };

inline int number(int low, int high) { return *rc::gen::inRange(low, high + 1); }
inline std::uint32_t count(int low, int high) { return static_cast<std::uint32_t>(number(low, high)); }

/// Stalls before the tokens of one end, drawn from a seed so that there is little to shrink.
inline std::vector<std::uint32_t> random_stalls(std::uint64_t tokens) {
  std::vector<std::uint32_t> all(tokens, 0);
  const int mode = number(0, 3);
  std::uint32_t state = count(1, 1000000);
  for (std::uint32_t& stall : all) {
    state = state * 1664525u + 1013904223u;
    const std::uint32_t draw = state >> 20;
    stall = mode == 0 ? 0 : mode == 1 ? draw % 8 : mode == 2 ? (draw % 6 == 0 ? draw % 200 : 0) : draw % 64;
  }
  return all;
}

inline StageTiming random_timing() {
  StageTiming timing;
  timing.interval = number(0, 7) == 0 ? 2 : 1;
  timing.latency = count(0, 24);
  if (number(0, 3) == 0) timing.row_overhead = count(0, 5);
  if (number(0, 3) == 0) timing.frame_overhead = count(0, 60);
  if (number(0, 3) == 0) timing.overlap = number(0, 1) == 0 ? FrameOverlap::kYes : FrameOverlap::kNo;
  return timing;
}

inline DmaPortConfig random_port() {
  DmaPortConfig port;
  port.data_bits = 8u << count(0, 3);
  port.burst_bytes = port.data_bits / 8 * count(1, 12);
  port.fifo_bytes = port.burst_bytes * count(1, 6);
  return port;
}

/// Tiles of one width that keep columns as they please.
inline TilePlan random_tiles(int width, int most) {
  TilePlan plan = one_tile(width);
  if (width < 2 || most < 2 || number(0, 2) != 0) return plan;
  plan.tiles.clear();
  for (int i = number(2, most); i > 0; --i) {
    const int begin = 2 * number(0, width / 2 - 1);
    plan.tiles.push_back({0, begin, begin + 2 * number(1, (width - begin) / 2)});
  }
  return plan;
}

/// Parallel rows that go with so many iterations and pixels a token.
inline int random_rows(int iterations, int pixels) {
  std::vector<int> all;
  for (int rows = 1; rows <= pixels * iterations; ++rows) {
    const bool whole = pixels % rows == 0 || rows % pixels == 0;
    if (whole && pixels * iterations % rows == 0) all.push_back(rows);
  }
  return all[number(0, static_cast<int>(all.size()) - 1)];
}

/// `frames` frames of a small image, `larger` times as wide and high, in tiles.
inline PipelineCase random_pipeline(Depths depths, std::uint64_t frames, int larger = 1, int most_tiles = 3) {
  PipelineCase c;
  MachineConfig& config = c.config;
  const int pixels = number(0, 1) == 0 ? 1 : number(2, 4);
  config.timing.pixels_per_token = pixels;
  config.timing.overlap_frames = number(0, 1) == 0;
  const int width = number(1, 48 / pixels) * pixels * larger;
  const int height = number(1, 16) * larger;
  config.rectification.range.window = 2 * number(0, 4) + 1;
  config.census.window_width = 2 * number(1, 3) + 1;
  config.census.window_height = 2 * number(0, 3) + 1;
  config.census.enabled = number(0, 7) != 0;
  if (!config.census.enabled) config.matching.cost = MatchingCost::kAbsoluteDifference;
  config.matching.parallelism = number(1, 8);
  config.matching.iterations = number(1, 3);
  if (number(0, 3) == 0) config.matching.recurrence_latency = number(2, 9);
  if (number(0, 1) == 0) config.matching.recurrence_order = RecurrenceOrder::kMinimumFirst;
  if (number(0, 2) == 0) config.matching.paths = count(1, 255);
  if (number(0, 2) == 0) config.matching.path_storage = PathStorage::kMemory;
  if (config.matching.path_storage == PathStorage::kOnChip && number(0, 1) == 0) {
    config.matching.parallel_rows = random_rows(config.matching.iterations, pixels);
  }
  config.consistency.enabled = number(0, 3) != 0;
  config.texture.enabled = number(0, 3) != 0;
  config.texture.window = 2 * number(1, 4) + 1;
  config.speckle.iterations = number(0, 2);
  config.gap_interpolation.enabled = number(0, 1) != 0;
  config.gap_interpolation.l_max = number(0, 8);
  config.noise_reduction.enabled = number(0, 3) != 0;
  if (number(0, 3) == 0) config.noise_reduction.kind = NoiseReductionKind::kMedian5x5;
  PipelineTiming& time = config.timing;
  for (StageTiming* timing : {&time.map_decoder, &time.rectification, &time.census, &time.matching,
                              &time.subpixel, &time.uniqueness, &time.consistency, &time.texture,
                              &time.speckle, &time.gap_interpolation, &time.noise_reduction}) {
    *timing = random_timing();
  }
  for (DmaPortConfig* port :
       {&config.dma.left, &config.dma.right, &config.dma.map, &config.dma.output, &config.dma.buffer}) {
    *port = random_port();
  }
  config.streams.default_depth = count(1, 20);
  config.streams.synchroniser_stages = count(1, 4);
  const auto kind = [] {
    return *rc::gen::element(FifoKind::kRegistered, FifoKind::kFirstWordFallThrough, FifoKind::kBlockRam,
                             FifoKind::kAsynchronous, FifoKind::kFree);
  };
  if (number(0, 1) == 0) config.streams.default_kind = kind();
  if (number(0, 1) == 0) {
    for (StreamKind& stream : config.streams.kinds) {
      if (number(0, 2) == 0) stream.kind = kind();
    }
  }
  for (StreamKind& stream : config.streams.kinds) {
    if (number(0, 5) == 0) stream.not_ready_cycles = count(1, 50);
    const FifoKind of = config.streams.kind(stream.name);
    if (of != FifoKind::kFree && of != FifoKind::kAsynchronous) continue;
    const int least = of == FifoKind::kFree ? 0 : 2;
    if (number(0, 1) == 0) stream.write_to_read = number(least, 6);
    if (number(0, 1) == 0) stream.read_to_write = number(least, 6);
  }
  if (depths == Depths::kRandom) {
    for (StreamDepth& stream : config.streams.depths) {
      if (number(0, 4) == 0) stream.tokens = count(1, number(0, 1) == 0 ? 20 : 400);
    }
  }
  c.tiles = random_tiles(width, most_tiles);
  const int rows = height * static_cast<int>(c.tiles.tiles.size());
  const OffsetRange& range = config.rectification.range;
  const int lens = number(0, 2);
  c.map = encode(lens == 0   ? identity_map(width, rows, range)
                 : lens == 1 ? lens_map(width, rows, range)
                             : noise_map(width, rows, range, count(1, 1000000)));
  const PipelineBursts bursts(c);
  c.left = random_stalls(frames * bursts.left);
  c.right = random_stalls(frames * bursts.right);
  c.map_stalls = random_stalls(frames * bursts.map);
  c.output = random_stalls(frames * bursts.output);
  c.rows_kept = random_stalls(frames * bursts.kept_rows);
  c.rows_returned = random_stalls(frames * bursts.kept_rows);
  c.frame_kept = random_stalls(frames * bursts.kept_frame);
  c.frame_returned = random_stalls(frames * bursts.kept_frame);
  return c;
}

}  // namespace parallax::test
