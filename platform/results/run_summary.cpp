// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "platform/machine/machine.hpp"
#include "platform/results/run_metrics.hpp"
#include "platform/results/stage_time.hpp"

namespace parallax {
namespace {

double number(const MetricGroup& metrics, const std::string& path) {
  const auto& value = metrics.at(path).value;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  return std::get<double>(value);
}

std::string word(const MetricGroup& metrics, const std::string& path) {
  return std::get<std::string>(metrics.at(path).value);
}

std::string memory_lines(const MetricGroup& m) {
  std::string text;
  std::vector<std::string> ports;
  for (const MetricGroup& group : m.groups) {
    if (group.name != "memory") continue;
    for (const MetricGroup& port : group.groups) {
      if (port.find("bytes_per_frame") != nullptr) ports.push_back(port.name);
    }
  }
  text += fmt::format("  {:<18}{:>9}  {:>8}  {:>10}  {:>16}  {:>6}  {:>7}\n", "port", "MB/s", "bus",
                      "B a frame", "latency, ns mean", "p95", "largest");
  std::stable_partition(ports.begin(), ports.end(), [](const std::string& port) { return port == "map"; });
  for (const std::string& port : ports) {
    const std::string path = "memory/" + port + "/";
    const std::string name = port == "map" ? "rectification map" : port;
    const std::string share =
        m.find(path + "share") == nullptr ? "-" : fmt::format("{:.2f} %", number(m, path + "share"));
    text += fmt::format("  {:<18}{:>9.1f}  {:>8}  {:>10.0f}  {:>16.0f}  {:>6.0f}  {:>7.0f}\n", name,
                        number(m, path + "bandwidth"), share, number(m, path + "bytes_per_frame"),
                        number(m, path + "latency_mean"), number(m, path + "latency_p95"),
                        number(m, path + "latency_largest"));
  }
  return text;
}

// What limits, and the keys that move it.
std::string limit_lines(const MetricGroup& m) {
  if (number(m, "performance/frame_rate") == 0) return "";  // one frame has no steady state
  std::string text;
  if (m.find("limit/verdict") != nullptr)
    text = fmt::format("verdict             {}\n", word(m, "limit/verdict"));
  if (word(m, "limit/part") == "none") {
    return text + fmt::format(
                      "limit               no part is at work all the time; the busiest, {}, is at {:.1f} %; "
                      "look at {}, "
                      "and at the look-ahead that each frame fills anew\n",
                      word(m, "limit/next_part"), number(m, "limit/utilisation"), word(m, "limit/key"));
  }
  return text + fmt::format("limit               {} at {:.1f} % of the time ({}); next {} at {:.1f} fps\n",
                            word(m, "limit/part"), number(m, "limit/utilisation"), word(m, "limit/key"),
                            word(m, "limit/next_part"), number(m, "limit/next_frame_rate"));
}

constexpr std::int64_t kBar = 50;  // characters

// As many characters of each part as it has of the whole, those with the largest remainders upward.
std::string bar(const std::vector<std::pair<char, std::int64_t>>& parts) {
  std::vector<std::int64_t> tenths;
  for (const auto& [character, share] : parts) tenths.push_back(share);
  std::string text;
  const std::vector<std::int64_t> lengths = shares_of(tenths, kBar);
  for (std::size_t i = 0; i < parts.size(); ++i)
    text.append(static_cast<std::size_t>(lengths[i]), parts[i].first);
  return text;
}

std::int64_t thousandths(double percent) { return std::llround(percent * 1000); }

// Where the time of each part goes, from the cameras to the host.
std::string pipeline_lines(const MetricGroup& m) {
  static constexpr std::array<char, kAllStageActivities.size()> kLetters{'#', 'e', 'f', 'm', 's', '.'};
  std::string text =
      "time                # busy, e upstream empty, f downstream full, m memory, s synchroniser, . "
      "blanking\n";
  const std::string limit = m.find("limit/part") == nullptr ? "" : word(m, "limit/part");
  const auto mark = [&limit](const std::string& part) { return part == limit ? "  limits" : ""; };
  const auto whole = [&](const std::string& part) {
    const std::string path = "limit/utilisation_by_part/" + part;
    if (m.find(path) == nullptr) return;
    const std::int64_t busy = thousandths(number(m, path));
    text += fmt::format("  {:<18}{} {:>5.1f} %{}\n", part, bar({{'#', busy}, {' ', thousandths(100) - busy}}),
                        number(m, path), mark(part));
  };
  whole("camera");
  whole("memory");
  whole("core");
  for (const MetricGroup& group : m.groups) {
    if (group.name != "stages") continue;
    for (const MetricGroup& stage : group.groups) {
      std::vector<std::pair<char, std::int64_t>> parts;
      for (std::size_t i = 0; i < kLetters.size(); ++i) {
        parts.emplace_back(kLetters.at(i),
                           static_cast<std::int64_t>(number(stage, name_of(kAllStageActivities[i]))));
      }
      text += fmt::format("  {:<18}{} {:>5.1f} %{}\n", stage.name, bar(parts), number(stage, "busy_share"),
                          mark(stage.name));
    }
  }
  whole("link");
  whole("host");
  return text;
}

std::string energy_line(const MetricGroup& m) {
  return fmt::format("energy              {:.2f} W estimated, {:.1f} mJ a frame\n",
                     number(m, "energy/power_total"), number(m, "energy/frame_total"));
}

std::string quality_lines(const MetricGroup& m) {
  std::string text;
  for (const MetricGroup& group : m.groups) {
    if (group.name != "quality" || group.metrics.empty()) continue;
    text += fmt::format("valid pixels        {:.1f} % of the image\n", number(m, "quality/valid_share"));
    if (group.metrics.size() == 1) continue;
    if (number(m, "quality/scored_pixels") == 0) {
      text += "ground truth        no pixel to score\n";
      continue;
    }
    text += fmt::format(
        "ground truth        coverage {:.1f} %, bad-1 {:.2f} %, bad-2 {:.2f} %, bad-3 {:.2f} %, mean error "
        "{:.3f} px\n",
        number(m, "quality/coverage"), number(m, "quality/bad_1"), number(m, "quality/bad_2"),
        number(m, "quality/bad_3"), number(m, "quality/mean_error"));
  }
  return text;
}

}  // namespace

std::string summary(const MetricGroup& m) {
  std::string text;
  const auto count = [&m](const char* path) { return static_cast<std::int64_t>(number(m, path)); };
  const std::int64_t offset = count("input/disparity_offset");
  text += fmt::format("image               {} x {} px", count("input/width"), count("input/height"));
  if (count("input/width") != count("input/processed_width") ||
      count("input/height") != count("input/processed_height")) {
    text += fmt::format(", processed as {} x {}", count("input/processed_width"),
                        count("input/processed_height"));
  }
  text += fmt::format(", disparities {} to {} px\n", offset, offset + count("input/disparity_range") - 1);
  const std::string window = m.at("performance/frame_rate").window;
  if (const double fps = number(m, "performance/frame_rate"); fps > 0) {
    text += fmt::format("frame rate          {:.2f} fps steady state ({})\n", fps, window);
    text += fmt::format("evaluations         {:.3f} billion a second, {:.2f} million disparities a second\n",
                        number(m, "performance/evaluations_per_second") / 1e9,
                        number(m, "performance/disparities_per_second") / 1e6);
  }
  text += fmt::format(
      "latency             {:.3f} ms to the first pixel, {:.3f} ms to the last, from frame in memory (first "
      "frame)\n",
      number(m, "latency/first_pixel_first_frame"), number(m, "latency/last_pixel_first_frame"));
  text += fmt::format("                    {:.3f} ms from exposure to the host, first frame {:.3f} ms\n",
                      number(m, "latency/exposure_to_host_mean"),
                      number(m, "latency/exposure_to_host_first_frame"));
  if (count("camera/dropped_frames") + count("camera/missed_triggers") + count("camera/faulty_frames") > 0) {
    text += fmt::format(
        "cameras             {} frames dropped (no buffer free), {} faulty, {} triggers missed (reading "
        "out)\n",
        count("camera/dropped_frames"), count("camera/faulty_frames"), count("camera/missed_triggers"));
  }
  text += pipeline_lines(m);
  text += limit_lines(m);
  if (m.find("memory/share") == nullptr) {  // another memory than the machine's own
    text += fmt::format("memory              {:.1f} MB/s\n", number(m, "memory/bandwidth"));
  } else {
    text += fmt::format("memory              {:.1f} of {:.0f} MB/s usable, bus taken {:.1f} % of the time",
                        number(m, "memory/bandwidth"), number(m, "memory/usable_bandwidth"),
                        number(m, "memory/share"));
    if (m.find("memory/row_hits") != nullptr)
      text += fmt::format(", {:.1f} % row hits", number(m, "memory/row_hits"));
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
      number(m, "latency/first_pixel_mean"), number(m, "latency/last_pixel_mean"),
      number(m, "memory/map/bytes_per_pixel_and_image"));
  for (const MetricGroup& group : m.groups) {
    if (group.name == "energy") {
      for (const Metric& metric : group.metrics) {
        if (metric.name.rfind("power_", 0) == 0) {
          text += fmt::format("energy {:<20}{:>5.2f} W estimated\n", metric.name.substr(6),
                              std::get<double>(metric.value));
        }
      }
    } else if (group.name == "stages") {
      for (const MetricGroup& stage : group.groups) {
        text += fmt::format(
            "stage  {:<20}{:>5.1f} % busy, {:>5.1f} % starved, {:>5.1f} % blocked, {:>5.1f} % memory, "
            "{:>5.1f} % "
            "blanking of {:.0f} cycles\n",
            stage.name, number(stage, "busy_share"), number(stage, "starved_share"),
            number(stage, "blocked_share"), number(stage, "memory_share"), number(stage, "blanking_share"),
            number(stage, "window"));
      }
    } else if (group.name == "streams") {
      for (const MetricGroup& stream : group.groups) {
        text += fmt::format(
            "stream {:<20}depth {:>6.0f} of {:>4.0f} bit, held {:>8.1f} mean, {:>6.0f} largest; full "
            "{:>5.1f} %, "
            "empty {:>5.1f} % of the time\n",
            stream.name, number(stream, "depth"), number(stream, "width"), number(stream, "mean_occupancy"),
            number(stream, "high_water"), number(stream, "full"), number(stream, "empty"));
      }
    }
  }
  return text;
}

}  // namespace parallax
