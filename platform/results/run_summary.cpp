// SPDX-License-Identifier: Apache-2.0
#include "platform/results/run_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "platform/results/stage_time.hpp"
#include "tlm/stage_activity.hpp"
#include "traces/metric_text.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

std::string value_at(const MetricGroup& m, const std::string& path) { return value_text(m.at(path)); }

// A port that moved nothing, such as that of a link that is off, is none of the table's.
std::string memory_lines(const MetricGroup& m) {
  std::vector<std::string> ports;
  for (const MetricGroup& port : m.group_at("memory").groups) {
    if (port.find("bytes_per_frame") != nullptr && port.number("bytes_per_frame") > 0)
      ports.push_back(port.name);
  }
  std::string text = fmt::format("  {:<19}{:>8}  {:>9}  {:>10}  {:>16}  {:>6}  {:>7} (whole run)\n", "port",
                                 "MB/s", "bus", "B a frame", "latency, ns mean", "p95", "largest");
  std::stable_partition(ports.begin(), ports.end(), [](const std::string& port) { return port == "map"; });
  for (const std::string& port : ports) {
    const std::string path = "memory/" + port + "/";
    const std::string name = port == "map" ? "rectification map" : port;
    const std::string share = m.find(path + "share") == nullptr ? "-" : metric_text(m.at(path + "share"));
    text += fmt::format("  {:<19}{:>8}  {:>9}  {:>10}  {:>16}  {:>6}  {:>7}\n", name,
                        value_at(m, path + "bandwidth"), share, value_at(m, path + "bytes_per_frame"),
                        value_at(m, path + "latency_mean"), value_at(m, path + "latency_p95"),
                        value_at(m, path + "latency_largest"));
  }
  return text;
}

// What limits, and the keys that move it.
std::string limit_lines(const MetricGroup& m) {
  if (m.number("performance/frame_rate") == 0) return "";  // one frame has no steady state
  std::string text;
  if (m.find("limit/verdict") != nullptr) text = filled_in(m, "verdict             {limit/verdict}\n");
  if (m.word("limit/part") == "none") {
    return text +
           filled_in(
               m,
               "limit               no part is at work all the time; the busiest, {limit/next_part}, is at "
               "{limit/utilisation}; look at {limit/key}, and at the look-ahead that each frame fills "
               "anew\n");
  }
  return text +
         filled_in(m,
                   "limit               {limit/part} at {limit/utilisation} of the time ({limit/key}); next "
                   "{limit/next_part} at {limit/next_frame_rate}\n");
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

// How much of the time each part is at work, from the cameras to the host, and where a stage's other time
// goes. Work has declared overheads in it, which the letters show as blanking.
class PartLines {
 public:
  explicit PartLines(const MetricGroup& m) : m_(m), limit_(m.word_or("limit/part", "none")) {}

  std::string text() {
    for (const MetricGroup& stage : m_.group_at("stages").groups)
      name_columns_ = std::max(name_columns_, stage.name.size());
    std::string lines =
        "time                # busy, e upstream empty, f downstream full, m memory, s synchroniser, . "
        "blanking; %: at work\n";
    for (const char* part : {"camera", "memory", "core"}) lines += whole(part);
    for (const MetricGroup& stage : m_.group_at("stages").groups) lines += of_stage(stage);
    for (const char* part : {"link", "host"}) lines += whole(part);
    // Another part, such as a DMA engine.
    if (!limit_shown_) lines += whole(limit_);
    return lines;
  }

 private:
  static constexpr std::array<char, kAllStageActivities.size()> kLetters{'#', 'e', 'f', 'm', 's', '.'};

  std::string line(const std::string& part, const std::string& letters, const Metric& share) {
    if (part == limit_) limit_shown_ = true;
    return fmt::format("  {:<{}} {} {:>8}{}\n", part, name_columns_, letters, metric_text(share),
                       part == limit_ ? "  limits" : "");
  }

  std::string whole(const std::string& part) {
    const Metric* const load = m_.find("limit/utilisation_by_part/" + part);
    if (load == nullptr) return "";
    const std::int64_t busy = thousandths(load->number());
    return line(part, bar({{'#', busy}, {' ', thousandths(100) - busy}}), *load);
  }

  // A single frame has no period to be at work in, but cycles.
  std::string of_stage(const MetricGroup& stage) {
    std::vector<std::pair<char, std::int64_t>> parts;
    for (std::size_t i = 0; i < kLetters.size(); ++i)
      parts.emplace_back(kLetters.at(i), stage.count(name_of(kAllStageActivities[i])));
    const Metric* const load = m_.find("limit/utilisation_by_part/" + stage.name);
    return line(stage.name, bar(parts), load == nullptr ? stage.at("busy_share") : *load);
  }

  const MetricGroup& m_;
  const std::string limit_;
  bool limit_shown_ = false;
  std::size_t name_columns_ = 17;
};

std::string quality_lines(const MetricGroup& m) {
  const MetricGroup* const quality = m.find_group("quality");
  if (quality == nullptr || quality->metrics.empty()) return "";
  std::string text = filled_in(m, "valid pixels        {quality/valid_share} of the image\n");
  if (quality->find("scored_pixels") == nullptr) return text;
  if (quality->number("scored_pixels") == 0) return text + "ground truth        no pixel to score\n";
  return text + filled_in(m,
                          "ground truth        coverage {quality/coverage}, bad-1 {quality/bad_1}, bad-2 "
                          "{quality/bad_2}, bad-3 {quality/bad_3}, mean error {quality/mean_error}\n");
}

// Where the latency is not steady.
std::string trend_line(const MetricGroup& m) {
  const double trend = m.number_or("steady/latency_trend", 0);
  if (trend == 0 && m.number_or("steady/frames", 0) >= 3 && m.word("steady/established") == "unknown")
    return "                    it may not be steady: a longer run shows (--timing-frames)\n";
  if (trend == 0) return "";
  std::string line =
      fmt::format("                    it is not steady, but {} by {} a frame", trend > 0 ? "grows" : "falls",
                  quantity_text(std::abs(trend), m.at("steady/latency_trend").unit));
  if (m.number_or("steady/frames_until_full", 0) > 0) {
    line += filled_in(m,
                      " until all buffers are full, to some {steady/latency_when_full} in about "
                      "{steady/frames_until_full} (--timing-frames)");
    if (m.find("steady/drops_when_full") != nullptr)
      line += filled_in(m, "; then at least {steady/drops_when_full} are dropped");
  }
  return line + "\n";
}

std::string image_line(const MetricGroup& m) {
  const std::int64_t offset = m.count("input/disparity_offset");
  std::string text =
      fmt::format("image               {} x {} px", m.count("input/width"), m.count("input/height"));
  if (m.count("input/width") != m.count("input/processed_width") ||
      m.count("input/height") != m.count("input/processed_height")) {
    text += fmt::format(", processed as {} x {}", m.count("input/processed_width"),
                        m.count("input/processed_height"));
  }
  return text +
         fmt::format(", disparities {} to {} px\n", offset, offset + m.count("input/disparity_range") - 1);
}

std::string rate_lines(const MetricGroup& m) {
  if (m.number("performance/frame_rate") == 0) return "";
  return filled_in(m, "frame rate          {performance/frame_rate} steady state") +
         fmt::format(" ({})\n", m.at("performance/frame_rate").window) +
         fmt::format("evaluations         {} a second, {} disparities a second\n",
                     value_at(m, "performance/evaluations_per_second"),
                     value_at(m, "performance/disparities_per_second"));
}

std::string camera_line(const MetricGroup& m) {
  if (m.count("camera/dropped_frames") + m.count("camera/missed_triggers") +
          m.count("camera/faulty_frames") ==
      0)
    return "";
  return filled_in(
      m,
      "cameras             {camera/dropped_frames} dropped (no buffer free), {camera/faulty_frames} "
      "faulty, {camera/missed_triggers} missed (reading out)\n");
}

std::string memory_line(const MetricGroup& m) {
  // Another memory than the machine's own.
  if (m.find("memory/share") == nullptr) return filled_in(m, "memory              {memory/bandwidth}\n");
  std::string text = fmt::format("memory              {} of ", value_at(m, "memory/bandwidth")) +
                     filled_in(m, "{memory/usable_bandwidth} usable, bus taken {memory/share} of the time");
  if (m.find("memory/row_hits") != nullptr) text += filled_in(m, ", {memory/row_hits} row hits");
  return text + '\n';
}

// What the core waits for before it starts with a frame.
std::string start_of_core(const MetricGroup& m) {
  const bool whole = m.count("input/startable_rows") == m.count("input/processed_height");
  return whole ? "frame in memory" : filled_in(m, "{input/startable_rows} of it in memory");
}

}  // namespace

std::string summary(const MetricGroup& m) {
  return image_line(m) + rate_lines(m) +
         filled_in(m,
                   "latency             {latency/first_pixel_first_frame} to the first pixel, "
                   "{latency/last_pixel_first_frame} to the last, from ") +
         start_of_core(m) +
         filled_in(m,
                   " (first frame)\n"
                   "                    {latency/exposure_to_host_mean} from exposure to ") +
         end_of_way(m) + filled_in(m, " (mean), first frame {latency/exposure_to_host_first_frame}\n") +
         trend_line(m) + camera_line(m) + PartLines(m).text() + limit_lines(m) + memory_line(m) +
         memory_lines(m) +
         filled_in(m, "energy              {energy/power_total} estimated, {energy/frame_total} a frame\n") +
         quality_lines(m);
}

std::string stage_summary(const MetricGroup& m) {
  std::string text =
      filled_in(m,
                "latency             {latency/first_pixel_mean} to the first pixel, "
                "{latency/last_pixel_mean} to the last, "
                "with frames before it under way\n"
                "map                 {memory/map/bytes_per_pixel_and_image} per pixel and image\n");
  for (const Metric& metric : m.group_at("energy").metrics) {
    if (metric.name.rfind("power_", 0) == 0)
      text += fmt::format("energy {:<19} {:>7} estimated\n", metric.name.substr(6), metric_text(metric));
  }
  for (const MetricGroup& stage : m.group_at("stages").groups) {
    std::string shares;
    for (const StageActivity activity : kAllStageActivities) {
      const Metric& share = stage.at(std::string(name_of(activity)) + "_share");
      if (activity == StageActivity::kSynchroniser && share.number() == 0)
        continue;  // only some FIFOs have one
      shares += fmt::format("{}{:>7} {}", shares.empty() ? "" : ", ", metric_text(share), name_of(activity));
    }
    text += fmt::format("stage  {:<19} {} of {}\n", stage.name, shares, metric_text(stage.at("window")));
  }
  for (const MetricGroup& stream : m.group_at("streams").groups) {
    text += fmt::format(
        "stream {:<19} depth {:>6} of {:>8}, held {:>8} mean, {:>6} largest; full {:>7}, empty {:>7} of the "
        "time\n",
        stream.name, value_text(stream.at("depth")), metric_text(stream.at("width")),
        value_text(stream.at("mean_occupancy")), value_text(stream.at("high_water")),
        metric_text(stream.at("full")), metric_text(stream.at("empty")));
  }
  return text;
}

}  // namespace parallax
