// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "platform/config/configuration.hpp"
#include "platform/machine/machine.hpp"
#include "tests/modules/random_maps.hpp"
#include "tests/paths.hpp"

namespace parallax::test {

/// The preset of this repository with assignments.
inline MachineConfig preset(const std::vector<std::string>& assignments = {}) {
  ConfigurationRequest request;
  request.assignments = assignments;
  return load_configuration(request, {source_path("platform/presets")}).machine;
}

/// Takes every limit away but the pipeline: memory, cameras and their buses take no time that counts, and
/// results stay in the memory.
inline MachineConfig pipeline_alone(MachineConfig config) {
  constexpr std::int64_t kFast = 10'000'000'000;
  config.memory.model = MemoryModel::kBus;
  config.clocks.memory_hz = kFast;
  config.clocks.camera_hz = kFast;
  config.memory.bytes_per_cycle = 1024;
  config.memory.latency_cycles = config.memory.latency_ns = 0;
  config.memory.efficiency = 100;
  config.camera.bytes_per_second = 1'000'000'000'000;
  config.camera.row_blanking = 0;
  config.camera.frame_blanking = 0;
  config.camera.frame_buffers = 8;
  config.dma.camera.outstanding = 64;
  config.dma.camera.burst_bytes = 1024;
  config.dma.camera.fifo_bytes = 65536;
  config.link.enabled = false;
  config.software.response_ns = 0;
  config.software.queue_frames = true;
  return config;
}

/// An image of bars of noise, three rows high, that begin `shift` px further left; `shift` at most 64. Two
/// that differ in it match.
inline SensorImage shifted_bars(int width, int height, std::size_t shift) {
  std::mt19937 random(7);
  auto pixels = std::make_shared<std::vector<Gray>>();
  std::vector<Gray> line(width + 64);
  for (int y = 0; y < height; ++y) {
    if (y % 3 == 0) {
      for (Gray& pixel : line) pixel = static_cast<Gray>(100 + random() % (y < 20 ? 6 : 120));
    }
    for (int x = 0; x < width; ++x) pixels->push_back(static_cast<Gray>(line[x + shift] + random() % 4));
  }
  return pixels;
}

/// A lens's map with noise on it, so that it takes about `bytes_per_pixel` bytes a pixel and image.
inline EncodedMap map_of_size(int width, int height, const OffsetRange& range, double bytes_per_pixel) {
  EncodedMap best;
  for (int noise = 0; noise <= 64; noise += noise < 8 ? 1 : 8) {
    RectificationMap map = lens_map(width, height, range);
    std::mt19937 random(1);
    for (OffsetPair& pair : map.offsets) {
      for (std::int16_t* offset : {&pair.left.dx, &pair.left.dy, &pair.right.dx, &pair.right.dy}) {
        const int shift = static_cast<int>(random() % static_cast<unsigned>(2 * noise + 1)) - noise;
        *offset = static_cast<std::int16_t>(std::clamp(*offset + shift, -range.limit(), range.limit()));
      }
    }
    best = encode(map);
    if (best.bytes_per_pixel() >= bytes_per_pixel) break;
  }
  return best;
}

}  // namespace parallax::test
