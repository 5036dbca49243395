// SPDX-License-Identifier: Apache-2.0
#include "platform/results/run_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "platform/machine/machine.hpp"
#include "platform/results/stage_time.hpp"
#include "tlm/stage_activity.hpp"

namespace parallax {
namespace {

std::string memory_lines(const MetricGroup& m) {
  std::string text;
  std::vector<std::string> ports;
  for (const MetricGroup& port : m.group_at("memory").groups) {
    if (port.find("bytes_per_frame") != nullptr) ports.push_back(port.name);
  }
  text += fmt::format("  {:<18}{:>9}  {:>8}  {:>10}  {:>16}  {:>6}  {:>7}\n", "port", "MB/s", "bus",
                      "B a frame", "latency, ns mean", "p95", "largest");
  std::stable_partition(ports.begin(), ports.end(), [](const std::string& port) { return port == "map"; });
  for (const std::string& port : ports) {
    const std::string path = "memory/" + port + "/";
    const std::string name = port == "map" ? "rectification map" : port;
    const std::string share =
        m.find(path + "share") == nullptr ? "-" : fmt::format("{:.2f} %", m.number(path + "share"));
    text += fmt::format("  {:<18}{:>9.1f}  {:>8}  {:>10.0f}  {:>16.0f}  {:>6.0f}  {:>7.0f}\n", name,
                        m.number(path + "bandwidth"), share, m.number(path + "bytes_per_frame"),
                        m.number(path + "latency_mean"), m.number(path + "latency_p95"),
                        m.number(path + "latency_largest"));
  }
  return text;
}

// What limits, and the keys that move it.
std::string limit_lines(const MetricGroup& m) {
  if (m.number("performance/frame_rate") == 0) return "";  // one frame has no steady state
  std::string text;
  if (m.find("limit/verdict") != nullptr)
    text = fmt::format("verdict             {}\n", m.word("limit/verdict"));
  if (m.word("limit/part") == "none") {
    return text + fmt::format(
                      "limit               no part is at work all the time; the busiest, {}, is at {:.1f} %; "
                      "look at {}, "
                      "and at the look-ahead that each frame fills anew\n",
                      m.word("limit/next_part"), m.number("limit/utilisation"), m.word("limit/key"));
  }
  return text + fmt::format("limit               {} at {:.1f} % of the time ({}); next {} at {:.1f} fps\n",
                            m.word("limit/part"), m.number("limit/utilisation"), m.word("limit/key"),
                            m.word("limit/next_part"), m.number("limit/next_frame_rate"));
}

constexpr std::int64_t kBarLength = 50;  // characters

// As many characters of each part as it has of the whole, those with the largest remainders upward.
std::string bar(const std::vector<std::pair<char, std::int64_t>>& parts) {
  std::vector<std::int64_t> tenths;
  for (const auto& [character, share] : parts) tenths.push_back(share);
  std::string text;
  const std::vector<std::int64_t> lengths = shares_of(tenths, kBarLength);
  for (std::size_t i = 0; i < parts.size(); ++i) text.append(lengths[i], parts[i].first);
  return text;
}

std::int64_t thousandths(double percent) { return std::llround(percent * 1000); }

// Where the time of each part goes, from the cameras to the host.
std::string pipeline_lines(const MetricGroup& m) {
  static constexpr std::array<char, kAllStageActivities.size()> kLetters{'#', 'e', 'f', 'm', 's', '.'};
  std::string text =
      "time                # busy, e upstream empty, f downstream full, m memory, s synchroniser, . "
      "blanking\n";
  const std::string limit = m.find("limit/part") == nullptr ? "" : m.word("limit/part");
  const auto mark = [&limit](const std::string& part) { return part == limit ? "  limits" : ""; };
  const auto whole = [&](const std::string& part) {
    const std::string path = "limit/utilisation_by_part/" + part;
    if (m.find(path) == nullptr) return;
    const std::int64_t busy = thousandths(m.number(path));
    text += fmt::format("  {:<18}{} {:>5.1f} %{}\n", part, bar({{'#', busy}, {' ', thousandths(100) - busy}}),
                        m.number(path), mark(part));
  };
  whole("camera");
  whole("memory");
  whole("core");
  for (const MetricGroup& stage : m.group_at("stages").groups) {
    std::vector<std::pair<char, std::int64_t>> parts;
    for (std::size_t i = 0; i < kLetters.size(); ++i)
      parts.emplace_back(kLetters.at(i), stage.count(name_of(kAllStageActivities[i])));
    text += fmt::format("  {:<18}{} {:>5.1f} %{}\n", stage.name, bar(parts), stage.number("busy_share"),
                        mark(stage.name));
  }
  whole("link");
  whole("host");
  return text;
}

std::string energy_line(const MetricGroup& m) {
  return fmt::format("energy              {:.2f} W estimated, {:.1f} mJ a frame\n",
                     m.number("energy/power_total"), m.number("energy/frame_total"));
}

std::string quality_lines(const MetricGroup& m) {
  const MetricGroup* const quality = m.find_group("quality");
  if (quality == nullptr || quality->metrics.empty()) return "";
  std::string text =
      fmt::format("valid pixels        {:.1f} % of the image\n", quality->number("valid_share"));
  if (quality->find("scored_pixels") == nullptr) return text;
  if (quality->number("scored_pixels") == 0) return text + "ground truth        no pixel to score\n";
  return text + fmt::format(
                    "ground truth        coverage {:.1f} %, bad-1 {:.2f} %, bad-2 {:.2f} %, bad-3 {:.2f} %, "
                    "mean error {:.3f} px\n",
                    quality->number("coverage"), quality->number("bad_1"), quality->number("bad_2"),
                    quality->number("bad_3"), quality->number("mean_error"));
}

// Where the latency is not steady.
std::string trend_line(const MetricGroup& m) {
  const double trend = m.number_or("steady/latency_trend", 0);
  if (trend == 0) return "";
  std::string line = fmt::format("                    it is not steady, but {} by {:.4f} ms a frame",
                                 trend > 0 ? "grows" : "falls", std::abs(trend));
  if (const Metric* const full = m.find("steady/latency_when_full")) {
    line += fmt::format(" until all buffers are full, to some {:.3f} ms in about {} frames (--timing-frames)",
                        full->number(), m.count("steady/frames_until_full"));
  }
  return line + "\n";
}

}  // namespace

std::string summary(const MetricGroup& m) {
  std::string text;
  const std::int64_t offset = m.count("input/disparity_offset");
  text += fmt::format("image               {} x {} px", m.count("input/width"), m.count("input/height"));
  if (m.count("input/width") != m.count("input/processed_width") ||
      m.count("input/height") != m.count("input/processed_height")) {
    text += fmt::format(", processed as {} x {}", m.count("input/processed_width"),
                        m.count("input/processed_height"));
  }
  text += fmt::format(", disparities {} to {} px\n", offset, offset + m.count("input/disparity_range") - 1);
  const std::string window = m.at("performance/frame_rate").window;
  if (const double fps = m.number("performance/frame_rate"); fps > 0) {
    text += fmt::format("frame rate          {:.2f} fps steady state ({})\n", fps, window);
    text += fmt::format("evaluations         {:.3f} billion a second, {:.2f} million disparities a second\n",
                        m.number("performance/evaluations_per_second") / 1e9,
                        m.number("performance/disparities_per_second") / 1e6);
  }
  text += fmt::format(
      "latency             {:.3f} ms to the first pixel, {:.3f} ms to the last, from frame in memory (first "
      "frame)\n",
      m.number("latency/first_pixel_first_frame"), m.number("latency/last_pixel_first_frame"));
  text += fmt::format("                    {:.3f} ms from exposure to the host, first frame {:.3f} ms\n",
                      m.number("latency/exposure_to_host_mean"),
                      m.number("latency/exposure_to_host_first_frame"));
  text += trend_line(m);
  if (m.count("camera/dropped_frames") + m.count("camera/missed_triggers") + m.count("camera/faulty_frames") >
      0) {
    text += fmt::format(
        "cameras             {} frames dropped (no buffer free), {} faulty, {} triggers missed (reading "
        "out)\n",
        m.count("camera/dropped_frames"), m.count("camera/faulty_frames"), m.count("camera/missed_triggers"));
  }
  text += pipeline_lines(m);
  text += limit_lines(m);
  if (m.find("memory/share") == nullptr) {  // another memory than the machine's own
    text += fmt::format("memory              {:.1f} MB/s\n", m.number("memory/bandwidth"));
  } else {
    text += fmt::format("memory              {:.1f} of {:.0f} MB/s usable, bus taken {:.1f} % of the time",
                        m.number("memory/bandwidth"), m.number("memory/usable_bandwidth"),
                        m.number("memory/share"));
    if (m.find("memory/row_hits") != nullptr)
      text += fmt::format(", {:.1f} % row hits", m.number("memory/row_hits"));
    text += '\n';
  }
  text += memory_lines(m);
  text += energy_line(m);
  text += quality_lines(m);
  return text;
}

std::string stage_summary(const MetricGroup& m) {
  std::string text = fmt::format(
      "latency             {:.3f} ms to the first pixel, {:.3f} ms to the last, with frames before it under "
      "way\n"
      "map                 {:.3f} B per pixel and image\n",
      m.number("latency/first_pixel_mean"), m.number("latency/last_pixel_mean"),
      m.number("memory/map/bytes_per_pixel_and_image"));
  for (const Metric& metric : m.group_at("energy").metrics) {
    if (metric.name.rfind("power_", 0) == 0)
      text += fmt::format("energy {:<20}{:>5.2f} W estimated\n", metric.name.substr(6), metric.number());
  }
  for (const MetricGroup& stage : m.group_at("stages").groups) {
    std::string shares;
    for (const StageActivity activity : kAllStageActivities) {
      const double share = stage.number(std::string(name_of(activity)) + "_share");
      if (activity == StageActivity::kSynchroniser && share == 0) continue;  // only some FIFOs have one
      shares += fmt::format("{}{:>5.1f} % {}", shares.empty() ? "" : ", ", share, name_of(activity));
    }
    text += fmt::format("stage  {:<20}{} of {:.0f} cycles\n", stage.name, shares, stage.number("window"));
  }
  for (const MetricGroup& stream : m.group_at("streams").groups) {
    text += fmt::format(
        "stream {:<20}depth {:>6.0f} of {:>4.0f} bit, held {:>8.1f} mean, {:>6.0f} largest; full "
        "{:>5.1f} %, "
        "empty {:>5.1f} % of the time\n",
        stream.name, stream.number("depth"), stream.number("width"), stream.number("mean_occupancy"),
        stream.number("high_water"), stream.number("full"), stream.number("empty"));
  }
  return text;
}

}  // namespace parallax
