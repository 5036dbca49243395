// SPDX-License-Identifier: Apache-2.0
// The machine around the pipeline: memory, latency, what limits, energy.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "traces/json_text.hpp"
#include "traces/metric_text.hpp"
#include "traces/number_text.hpp"
#include "traces/report/html.hpp"
#include "traces/report/page_text.hpp"
#include "traces/report/sections.hpp"

namespace parallax {
namespace {

using Json = nlohmann::ordered_json;

std::string select_box(const char* id, const char* label, const std::string& options) {
  return fmt::format("<p class=\"script-only\"><label>{} <select id=\"{}\">{}</select></label></p>\n", label,
                     id, options);
}

// A span's name, which ends at the host, of a machine that has none.
std::string span_words(const MetricGroup& tree, const std::string& span) {
  constexpr std::string_view kHost = "_host";
  if (span.size() < kHost.size() || span.substr(span.size() - kHost.size()) != kHost) return words(span);
  return words(span.substr(0, span.size() - kHost.size())) + " " + end_of_way(tree);
}

}  // namespace

std::string memory_section(const ReportInput& input) {
  const MetricGroup* const memory = input.metrics.find_group("memory");
  if (memory == nullptr) return "";
  std::string summary;
  Table table("What passed each port of the memory",
              {"port", "B a frame", "MB/s", "share of the bus", "latency, ns: mean", "p50", "p95", "p99",
               "largest", "stalls caused"});
  for (const Metric& metric : memory->metrics) {
    summary += fmt::format("{}{} {}", summary.empty() ? "" : "; ",
                           term(words(metric.name), metric.description), page_text(metric));
  }
  for (const MetricGroup& port : memory->groups) {
    std::vector<std::string> cells = {escaped(words(port.name)), page_number(port, "bytes_per_frame"),
                                      page_number(port, "bandwidth"), page_text(port, "share")};
    for (const char* latency : {"mean", "p50", "p95", "p99", "largest"})
      cells.push_back(page_number(port, fmt::format("latency_{}", latency)));
    cells.push_back(page_text(port, "stalls"));
    table.row(cells);
  }
  std::string html = fmt::format("<p>{}</p>\n{}", summary, table.html());
  const Json frame = input.profile.is_object() ? input.profile.value("frame", Json()) : Json();
  if (!frame.is_object()) return html;
  html += "<h3>Bandwidth by port over a frame's period</h3>\n" +
          canvas("chart-memory", "Bandwidth of each port over a frame's period");
  Table totals("Over this period, each port's bandwidth in bins of " +
                   page_number(frame.at("bin").get<double>() / 1e6, "us") + " us",
               {"port", "mean, MB/s", "largest bin, MB/s"});
  for (const auto& [port, bins] : frame.at("bandwidth").items()) {
    double sum = 0, most = 0;
    for (const Json& bin : bins) {
      sum += bin.get<double>();
      most = std::max(most, bin.get<double>());
    }
    totals.row({escaped(words(port)), page_number(sum / static_cast<double>(bins.size()), "MB/s"),
                page_number(most, "MB/s")});
  }
  html += totals.html();
  if (!frame.at("rows").contains("map")) return html;
  const Json& map = frame.at("rows").at("map");
  html += "<h3>The rectification map row by row</h3>\n" +
          canvas("chart-map", "Bytes and latency of each row of the rectification map");
  Table rows("", {"row", "bytes", "latency of its bursts, ns: mean", "longest"});
  for (std::size_t i = 0; i < map.at("bytes").size(); ++i)
    rows.row({std::to_string(i), page_number(map.at("bytes").at(i).get<double>(), "B"),
              page_number(map.at("latency_mean").at(i).get<double>() / 1e3, "ns"),
              page_number(map.at("latency_longest").at(i).get<double>() / 1e3, "ns")});
  return html + "<details><summary>As a table</summary>\n" + rows.html() + "</details>\n";
}

std::string latency_section(const ReportInput& input) {
  const MetricGroup* const latency = input.metrics.find_group("latency");
  if (latency == nullptr) return "";
  Table table("Of a frame, ms", {"span", "first frame", "mean", "p50", "p95", "p99", "largest"});
  const std::string suffix = "_first_frame";
  std::string options;
  const auto option = [&](const std::string& name, const char* unit) {
    options +=
        fmt::format("<option value=\"{}\" data-unit=\"{}\"{}>{}</option>", escaped(name), unit,
                    name == "exposure_to_host" ? " selected" : "", escaped(span_words(input.metrics, name)));
  };
  const Json counts = input.profile.is_object() ? input.profile.value("latency", Json()) : Json();
  for (const Metric& metric : latency->metrics) {
    const std::string& key = metric.name;
    if (key.size() <= suffix.size() || key.substr(key.size() - suffix.size()) != suffix) continue;
    const std::string span = key.substr(0, key.size() - suffix.size());
    std::vector<std::string> cells = {metric_term(*latency, key, span_words(input.metrics, span))};
    for (const char* what : {"first_frame", "mean", "p50", "p95", "p99", "largest"})
      cells.push_back(page_number(*latency, fmt::format("{}_{}", span, what)));
    table.row(cells);
    if (counts.contains(span) && !counts.at(span).at("count").empty()) option(span, "ms");
  }
  if (counts.is_object()) {
    for (const auto& port : counts.items()) {
      if (input.metrics.find_group("memory/" + port.key()) != nullptr && !port.value().at("count").empty())
        option(port.key(), "ns");
    }
  }
  if (options.empty()) return table.html();
  return select_box("span", "Distribution of", options) +
         canvas("chart-latency", "Distribution of a latency") + table.html();
}

std::string limits_section(const ReportInput& input) {
  if (!input.relaxations.is_object()) return "";
  Table table("One limit taken away at a time, and the machine run again",
              {"limit taken away", "frames/s", "gain", "exposure to " + end_of_way(input.metrics) + ", ms",
               "limits then", "meaning", "settings"},
              "words");
  const MetricGroup base = metrics_of(input.relaxations.at("base"));
  table.row({"none", page_number(base.at("frame_rate")), "", page_number(base.at("latency")), "",
             "the machine as it is", ""});
  const std::string limit = input.relaxations.value("limit", "");
  for (const Json& entry : input.relaxations.at("relaxations")) {
    const std::string name = entry.value("name", "");
    std::string settings;
    for (const Json& setting : entry.at("set"))
      settings += (settings.empty() ? "" : " ") + setting.get<std::string>();
    if (!entry.contains("gain")) {
      table.row({escaped(words(name)), "", "", "", "", escaped(entry.value("message", "")), ""});
      continue;
    }
    const MetricGroup numbers = metrics_of(entry);
    table.row(
        {escaped(words(name)), page_number(numbers.at("frame_rate")),
         change_text(numbers.number("gain"), "%") + "&nbsp;%", page_number(numbers.at("latency")),
         escaped(words(entry.value("next_part", ""))), escaped(entry.value("meaning", "")),
         settings.size() < 80 ? escaped(settings)
                              : "<details><summary>all streams</summary>" + escaped(settings) + "</details>"},
        name == limit ? "class=\"limits\"" : "");
  }
  return canvas("chart-limits", "Gain of the frame rate for each limit taken away") + table.html();
}

std::string energy_section(const ReportInput& input) {
  const MetricGroup* const energy = input.metrics.find_group("energy");
  if (energy == nullptr) return "";
  Table table("An estimate: what the parts did, times what a unit of it costs (keys energy.* of the preset)",
              {"part", "W", "mJ a frame", "what it holds"}, "words");
  const std::string prefix = "power_";
  for (const Metric& metric : energy->metrics) {
    if (metric.name.rfind(prefix, 0) != 0) continue;
    const std::string part = metric.name.substr(prefix.size());
    table.row({escaped(words(part)), page_number(metric), page_number(energy->at("frame_" + part)),
               escaped(metric.description)});
  }
  return canvas("chart-energy", "Estimated power of each part") + table.html();
}

namespace {

void add_numbers(Table& table, const MetricGroup& group, const std::string& path) {
  for (const Metric& metric : group.metrics) {
    table.row({escaped(path + metric.name), page_text(metric), escaped(metric.description),
               escaped(metric.window)});
  }
  for (const MetricGroup& child : group.groups) add_numbers(table, child, path + child.name + "/");
}

void add_keys(std::string& text, const Json& group, const std::string& path) {
  for (const auto& [name, entry] : group.items()) {
    const std::string here = path.empty() ? name : path + "." + name;
    if (entry.is_object()) {
      add_keys(text, entry, here);
    } else {
      text += fmt::format("{} = {}\n", here, json_text(entry));
    }
  }
}

}  // namespace

std::string numbers_section(const ReportInput& input) {
  Table table("", {"number", "value", "meaning", "over"}, "words");
  add_numbers(table, input.metrics, "");
  return "<details><summary>Every number of timing.json, with its meaning</summary>\n" + table.html() +
         "</details>\n";
}

std::string configuration_section(const ReportInput& input) {
  std::string keys;
  add_keys(keys, input.configuration, "");
  return fmt::format(
      "<p>This command makes the run again: "
      "<button class=\"copy script-only\" type=\"button\" data-of=\"command\">copy</button></p>\n"
      "<pre class=\"command\" id=\"command\">{}</pre>\n"
      "<details><summary>Every key of the configuration</summary>\n<pre "
      "class=\"command\">{}</pre></details>\n",
      escaped(input.metrics.word_or("run/command", "")), escaped(keys));
}

}  // namespace parallax
