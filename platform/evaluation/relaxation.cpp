// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/relaxation.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace parallax {
namespace {

constexpr std::int64_t kFastestClock = 10'000'000'000;  // Hz, the largest that a configuration takes
constexpr std::int64_t kDeeper = 16;
constexpr std::int64_t kDeepest = 1 << 20;  // tokens; deeper FIFOs take memory of this computer

Relaxation clock(Relief limit, const char* name, std::int64_t hertz) {
  return {limit,
          "twice as fast",
          fmt::format("doubling the {}'s clock", name),
          {fmt::format("clocks.{}_hz={}", name, std::min(2 * hertz, kFastestClock))}};
}

// FIFOs between stages; those of DMA engines have keys of their own.
std::vector<std::string> deeper_fifos(const MetricGroup& metrics) {
  std::vector<std::string> assignments;
  for (const std::string& name : pipeline_stream_names()) {
    const Metric* const metric = metrics.find("streams/" + name + "/depth");
    if (metric == nullptr) continue;  // a machine without it
    const std::int64_t depth = metric->count();
    assignments.push_back(fmt::format("streams.{}.depth={}", name,
                                      std::max(depth, std::min(kDeeper * depth + 1024, kDeepest))));
  }
  return assignments;
}

std::vector<std::string> longer_queues(const DmaConfig& dma) {
  std::vector<std::string> assignments;
  const auto add = [&](const char* name, const DmaPortConfig& port) {
    const std::uint32_t outstanding = std::min(8 * port.outstanding, 256U);
    assignments.push_back(fmt::format("dma.{}.outstanding={}", name, outstanding));
    assignments.push_back(
        fmt::format("dma.{}.fifo_bytes={}", name,
                    std::min(std::max(port.fifo_bytes, 2 * outstanding * port.burst_bytes), 1U << 20)));
  };
  add("camera", dma.camera);
  add("left", dma.left);
  add("right", dma.right);
  add("map", dma.map);
  add("output", dma.output);
  add("link", dma.link);
  add("buffer", dma.buffer);
  return assignments;
}

Relaxation memory_clock(const MachineConfig& config) {
  if (config.memory.model == MemoryModel::kBus)
    return clock(Relief::kMemoryClock, "memory", config.clocks.memory_hz);
  return {Relief::kMemoryClock,
          "twice as fast",
          "doubling the memory's clock",
          {fmt::format("dram.clock_period_ps={}",
                       std::max<std::int64_t>(config.memory.dram.clock_period_ps / 2, 100))}};
}

std::int64_t larger_memory(const MemoryConfig& config) {
  const std::int64_t larger = std::min(4 * config.size_bytes, std::int64_t{1} << 40);
  return config.model == MemoryModel::kBus ? larger : std::min(larger, config.dram.bytes());
}

}  // namespace

std::vector<Relaxation> relaxations(const MachineConfig& config, const MetricGroup& metrics) {
  std::vector<Relaxation> all{
      {Relief::kFifos, "between stages, 16 times and 1024 tokens deeper", "deeper FIFOs",
       deeper_fifos(metrics)},
      {Relief::kMemory,
       "no latency, all of 1024 B a cycle",
       "a memory without limits",
       {"memory.model=bus", "memory.bytes_per_cycle=1024", "memory.latency_cycles=0",
        "memory.efficiency=100"}},
      {Relief::kDma, "8 times as many bursts under way", "8 times as many bursts under way",
       longer_queues(config.dma)},
      {Relief::kCamera,
       "any rate, cable and pixel clock",
       "cameras without limits",
       {fmt::format("clocks.camera_hz={}", kFastestClock), "camera.bytes_per_second=1000000000000",
        "camera.frame_rate=0", "camera.jitter_ns=0", "camera.exposure_ns=0", "camera.skew_ns=0",
        "camera.row_blanking=0", "camera.frame_blanking=0"}},
      {Relief::kBuffers,
       "twice as many for frames and results",
       "twice as many buffers",
       {fmt::format("camera.frame_buffers={}", std::min(2 * config.camera.frame_buffers, 64U)),
        fmt::format("link.output_buffers={}", std::min(2 * config.link.output_buffers, 64U)),
        fmt::format("memory.size_bytes={}", larger_memory(config.memory))}},
      clock(Relief::kCoreClock, "core", config.clocks.core_hz),
      memory_clock(config),
      clock(Relief::kCameraClock, "camera", config.clocks.camera_hz)};
  if (config.timing.matching.interval > 1 || config.matching.recurrence_latency > 1) {
    all.push_back({Relief::kMatchingInterval,
                   "one iteration a cycle, pixel after pixel",
                   "a matcher without interval or recurrence",
                   {"matching.interval=1", "matching.recurrence_latency=1"}});
  }
  if (config.matching.path_storage == PathStorage::kMemory || (config.matching.paths & kSouthernPaths) != 0) {
    all.push_back({Relief::kBufferPort,
                   "8192 bit a cycle",
                   "a wider buffer port",
                   {"dma.buffer.data_bits=8192",
                    fmt::format("dma.buffer.burst_bytes={}",
                                std::min((config.dma.buffer.burst_bytes + 1023) / 1024 * 1024, 4096U)),
                    "dma.buffer.fifo_bytes=1048576"}});
  }
  if (config.matching.path_storage == PathStorage::kMemory) {
    all.push_back({Relief::kPathStorage, "on chip", "path costs on chip", {"matching.path_storage=on_chip"}});
  }
  if (config.software.response_ns > 0 || !config.software.queue_frames) {
    all.push_back({Relief::kSoftware,
                   "no time between frames, which queue",
                   "software that takes no time",
                   {"software.response_ns=0", "software.queue_frames=true"}});
  }
  if (config.link.enabled) {
    all.push_back(clock(Relief::kLinkClock, "link", config.clocks.link_hz));
    all.push_back({Relief::kLink, "1 Tbit/s", "a link of 1 Tbit/s", {"link.line_rate=1000000000000"}});
    if (config.link.host_pixel_rate > 0)
      all.push_back(
          {Relief::kHost, "takes pixels at any rate", "a host of any rate", {"link.host_pixel_rate=0"}});
  }
  return all;
}

}  // namespace parallax
