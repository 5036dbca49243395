// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/relaxation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace parallax {
namespace {

constexpr std::int64_t kFastestClock = 10'000'000'000;  // Hz, the largest that a configuration takes
constexpr std::int64_t kDeeper = 16;
constexpr std::int64_t kDeepest = 1 << 20;  // tokens; deeper FIFOs take memory of this computer

Relaxation one(Relief limit, std::string meaning, std::string remedy, std::vector<std::string> assignments) {
  Relaxation relaxation{name_of(limit),    spoken(name_of(limit)), std::move(meaning),
                        std::move(remedy), std::move(assignments), {limit}};
  relaxation.subject_is_plural = limit == Relief::kFifos || limit == Relief::kBuffers;
  relaxation.remedy_is_plural = relaxation.subject_is_plural || limit == Relief::kDma ||
                                limit == Relief::kCamera || limit == Relief::kPathStorage;
  if (limit == Relief::kFifos) relaxation.subject = "FIFOs";
  return relaxation;
}

Relaxation clock(Relief limit, const char* name, std::int64_t hertz) {
  return one(limit, "twice as fast", fmt::format("doubling the {}'s clock", name),
             {fmt::format("clocks.{}_hz={}", name, std::min(2 * hertz, kFastestClock))});
}

std::string depth_of(const std::string& stream, std::int64_t tokens) {
  return fmt::format("streams.{}.depth={}", stream, tokens);
}

// FIFOs between stages; those of DMA engines have keys of their own.
std::vector<std::string> deeper_fifos(const MetricGroup& metrics) {
  std::vector<std::string> assignments;
  for (const std::string& name : pipeline_stream_names()) {
    const Metric* const metric = metrics.find("streams/" + name + "/depth");
    if (metric == nullptr) continue;  // a machine without it
    assignments.push_back(depth_of(name, deep_enough(metric->count())));
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
  return one(Relief::kMemoryClock, "twice as fast", "doubling the memory's clock",
             {fmt::format("dram.clock_period_ps={}",
                          std::max<std::int64_t>(config.memory.dram.clock_period_ps / 2, 100))});
}

// Bytes of the widest port that a burst of this length fills whole.
std::uint32_t widest_beat(std::uint32_t burst_bytes) {
  std::uint32_t beat = std::min(burst_bytes, 1024U);
  while (burst_bytes % beat != 0) --beat;
  return beat;
}

std::int64_t larger_memory(const MemoryConfig& config) {
  const std::int64_t larger = std::min(4 * config.size_bytes, std::int64_t{1} << 40);
  return config.model == MemoryModel::kBus ? larger : std::min(larger, config.dram.bytes());
}

}  // namespace

std::vector<Relaxation> relaxations(const MachineConfig& config, const MetricGroup& metrics) {
  std::vector<Relaxation> all{
      one(Relief::kFifos, "between stages, 16 times and 1024 tokens deeper", "deeper FIFOs",
          deeper_fifos(metrics)),
      one(Relief::kMemory, "no latency, all of 1024 B a cycle", "a memory without limits",
          {"memory.model=bus", "memory.bytes_per_cycle=1024", "memory.latency_cycles=0",
           "memory.latency_ns=0", "memory.efficiency=100",
           fmt::format("clocks.memory_hz={}", kFastestClock)}),
      one(Relief::kDma, "8 times as many bursts under way", "8 times as many bursts under way",
          longer_queues(config.dma)),
      one(Relief::kCamera, "any rate, cable and pixel clock", "cameras without limits",
          {fmt::format("clocks.camera_hz={}", kFastestClock), "camera.bytes_per_second=1000000000000",
           "camera.frame_rate=0", "camera.jitter_ns=0", "camera.exposure_ns=0", "camera.skew_ns=0",
           "camera.row_blanking=0", "camera.frame_blanking=0"}),
      one(Relief::kBuffers, "twice as many for frames and results", "twice as many buffers",
          {fmt::format("camera.frame_buffers={}", std::min(2 * config.camera.frame_buffers, 64U)),
           fmt::format("link.output_buffers={}", std::min(2 * config.link.output_buffers, 64U)),
           fmt::format("memory.size_bytes={}", larger_memory(config.memory))}),
      clock(Relief::kCoreClock, "core", config.clocks.core_hz),
      memory_clock(config),
      clock(Relief::kCameraClock, "camera", config.clocks.camera_hz)};
  if (!config.timing.overlap_frames) {
    all.push_back(one(Relief::kFrameGap, "the next frame enters while the last one drains",
                      "letting the next frame in while the last one drains",
                      {"pipeline.overlap_frames=true"}));
  }
  if (config.timing.matching.interval > 1 || config.matching.recurrence_latency > 1) {
    all.push_back(one(Relief::kMatchingInterval, "one iteration a cycle, pixel after pixel",
                      "a matcher without interval or recurrence",
                      {"matching.interval=1", "matching.recurrence_latency=1"}));
  }
  if (config.matching.path_storage == PathStorage::kMemory || (config.matching.paths & kSouthernPaths) != 0) {
    const std::uint32_t beat = widest_beat(config.dma.buffer.burst_bytes);
    all.push_back(one(Relief::kBufferPort, fmt::format("{} bit a cycle", 8 * beat), "a wider buffer port",
                      {fmt::format("dma.buffer.data_bits={}", 8 * beat), "dma.buffer.fifo_bytes=1048576"}));
  }
  if (config.matching.path_storage == PathStorage::kMemory) {
    all.push_back(
        one(Relief::kPathStorage, "on chip", "path costs on chip", {"matching.path_storage=on_chip"}));
  }
  const bool takes_time = config.software.response_ns > 0 || config.software.register_ns > 0;
  if (takes_time || !config.software.queue_frames) {
    const char* const remedy = !takes_time ? "software that queues frames"
                               : config.software.queue_frames
                                   ? "software that takes no time"
                                   : "software that takes no time and queues frames";
    all.push_back(one(Relief::kSoftware, "no time between frames, which queue", remedy,
                      {"software.response_ns=0", "software.register_ns=0", "software.queue_frames=true"}));
  }
  if (config.link.enabled) {
    all.push_back(clock(Relief::kLinkClock, "link", config.clocks.link_hz));
    all.push_back(one(Relief::kLink, "1 Tbit/s", "a link of 1 Tbit/s", {"link.line_rate=1000000000000"}));
    if (config.link.host_pixel_rate > 0)
      all.push_back(
          one(Relief::kHost, "takes pixels at any rate", "a host of any rate", {"link.host_pixel_rate=0"}));
  }
  return all;
}

std::int64_t deep_enough(std::int64_t depth) {
  return std::max(depth, std::min(kDeeper * depth + 1024, kDeepest));
}

std::vector<Relaxation> fifo_relaxations(const MetricGroup& metrics, bool full) {
  std::vector<std::pair<double, Relaxation>> found;
  for (const std::string& stream : pipeline_stream_names()) {
    const MetricGroup* const group = metrics.find_group("streams/" + stream);
    if (group == nullptr || (full && group->number("full") == 0)) continue;
    found.emplace_back(group->number("full"),
                       fifo_relaxation(metrics, stream, deep_enough(group->count("depth"))));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Relaxation> all;
  for (auto& [share, relaxation] : found) all.push_back(std::move(relaxation));
  return all;
}

Relaxation fifo_relaxation(const MetricGroup& metrics, const std::string& stream, std::int64_t tokens) {
  const std::int64_t depth = metrics.count("streams/" + stream + "/depth");
  Relaxation fifo = one(Relief::kFifos, fmt::format("{} instead of {} tokens", tokens, depth),
                        fmt::format("a depth of {}", tokens), {depth_of(stream, tokens)});
  fifo.name = "fifo_" + stream;
  fifo.subject = fmt::format("FIFO {} with its depth of {}", stream, depth);
  fifo.fifos = {stream};
  fifo.subject_is_plural = fifo.remedy_is_plural = false;
  return fifo;
}

Relaxation fifos_relaxation(const MetricGroup& metrics, const std::vector<std::string>& streams,
                            const std::vector<std::int64_t>& tokens) {
  constexpr std::size_t kMostInWords = 3;
  std::vector<Relaxation> each;
  for (std::size_t i = 0; i < streams.size(); ++i)
    each.push_back(fifo_relaxation(metrics, streams[i], tokens[i]));
  Relaxation all = together(each);
  if (streams.size() > kMostInWords) all.subject = fmt::format("FIFOs {}", fmt::join(streams, ", "));
  all.remedy = fmt::format("depths of {}", fmt::join(tokens, ", "));
  return all;
}

std::optional<Relaxation> default_depth_relaxation(const MachineConfig& config,
                                                   const std::vector<Relaxation>& fifos,
                                                   std::int64_t tokens) {
  const std::int64_t now = config.streams.default_depth;
  const auto has_it = [&](const Relaxation& fifo) {
    const auto configured = std::find_if(config.streams.depths.begin(), config.streams.depths.end(),
                                         [&](const StreamDepth& d) { return d.name == fifo.fifos.front(); });
    return configured->tokens == 0;
  };
  if (std::count_if(fifos.begin(), fifos.end(), has_it) < 2) return std::nullopt;
  Relaxation all =
      one(Relief::kFifos, fmt::format("default depth {} instead of {} tokens", tokens, now),
          fmt::format("a default depth of {}", tokens), {fmt::format("streams.default_depth={}", tokens)});
  all.name = "fifos_default_depth";
  all.remedy_is_plural = false;
  all.subject = fmt::format("FIFOs with their default depth of {}", now);
  return all;
}

std::vector<std::int64_t> fifo_depths(const MachineConfig& config, const MetricGroup& metrics,
                                      const std::string& stream) {
  const std::int64_t depth = metrics.count("streams/" + stream + "/depth");
  std::vector<std::int64_t> depths;
  for (std::int64_t tokens = 2 * depth; tokens < deep_enough(depth); tokens *= 2) depths.push_back(tokens);
  const auto configured = std::find_if(config.streams.depths.begin(), config.streams.depths.end(),
                                       [&](const StreamDepth& d) { return d.name == stream; });
  if (configured->tokens != 0) depths.push_back(0);
  return depths;
}

Relaxation together(const std::vector<Relaxation>& some) {
  if (some.size() == 1) return some.front();
  const auto has = [&](Relief limit) {
    return std::any_of(some.begin(), some.end(), [limit](const Relaxation& r) {
      return r.fifos.empty() && std::find(r.limits.begin(), r.limits.end(), limit) != r.limits.end();
    });
  };
  Relaxation all;
  const auto join = [](std::string& text, const char* between, const std::string& more) {
    if (!text.empty()) text += between;
    text += more;
  };
  for (const Relaxation& relaxation : some) {
    join(all.name, "+", relaxation.name);
    join(all.subject, " and ", relaxation.subject);
    join(all.meaning, "; ", relaxation.meaning);
    join(all.remedy, " and ", relaxation.remedy);
    all.limits.insert(all.limits.end(), relaxation.limits.begin(), relaxation.limits.end());
    all.fifos.insert(all.fifos.end(), relaxation.fifos.begin(), relaxation.fifos.end());
    all.subject_is_plural = all.remedy_is_plural = true;
    const bool held_by_another =
        (relaxation.limits.front() == Relief::kCameraClock && has(Relief::kCamera)) ||
        (relaxation.limits.front() == Relief::kMemoryClock && has(Relief::kMemory)) ||
        (!relaxation.fifos.empty() && has(Relief::kFifos));
    if (held_by_another) continue;
    all.assignments.insert(all.assignments.end(), relaxation.assignments.begin(),
                           relaxation.assignments.end());
  }
  return all;
}

}  // namespace parallax
