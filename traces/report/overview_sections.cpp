// SPDX-License-Identifier: Apache-2.0
// What a reader looks at first: figures, images, and whether it is what was published.
#include <fmt/format.h>

#include "traces/report/html.hpp"
#include "traces/report/metric_text.hpp"
#include "traces/report/sections.hpp"

namespace parallax {
namespace {

std::string card(const std::string& value, const std::string& name) {
  return fmt::format("<div class=\"card\"><div class=\"value\">{}</div><div class=\"name\">{}</div></div>\n",
                     escaped(value), name);
}

std::string card(const MetricGroup& tree, const char* path, const char* name) {
  const Metric* const metric = tree.find(path);
  return metric == nullptr ? "" : card(metric_text(*metric), metric_term(tree, path, name));
}

std::string large_number(double value, const std::string& unit) {
  if (value >= 1e9) return escaped(fmt::format("{:.3g} billion {}", value / 1e9, unit));
  if (value >= 1e6) return escaped(fmt::format("{:.3g} million {}", value / 1e6, unit));
  return escaped(fmt::format("{:.5g} {}", value, unit));
}

std::string per_second(const MetricGroup& tree, const char* path, double unit, const char* unit_name,
                       const char* name) {
  if (tree.find(path) == nullptr) return "";
  return card(number_text(tree.number(path) / unit, 2) + " " + unit_name, metric_term(tree, path, name));
}

std::string stuck_banner(const MetricGroup& deadlock) {
  std::string waits;
  for (const MetricGroup& wait : deadlock.groups) {
    waits += fmt::format("<li>{} waits on stream <b>{}</b> ({}, depth {}) for {}</li>\n",
                         escaped(wait.word("waiter")), escaped(wait.word("stream")),
                         escaped(wait.word("state")), wait.count("depth"), escaped(wait.word("waits_for")));
  }
  return fmt::format(
      "<div class=\"verdict stuck\" role=\"alert\"><b>The machine got stuck</b> before the host had all "
      "frames.\n<ol>{}</ol>\n<b>Remedy:</b> {}</div>\n",
      waits, escaped(deadlock.word("remedy")));
}

std::string verdict_banner(const MetricGroup& tree) {
  if (const MetricGroup* const deadlock = tree.find_group("deadlock")) return stuck_banner(*deadlock);
  std::string sentence = tree.word_or("limit/verdict", "");
  if (sentence.empty() && tree.find("limit/part") != nullptr) {
    sentence =
        fmt::format("{} at {:.1f} % of the time", tree.word("limit/part"), tree.number("limit/utilisation"));
  }
  return sentence.empty() ? "" : fmt::format("<p class=\"verdict\">{}</p>\n", escaped(sentence));
}

}  // namespace

std::string overview(const ReportInput& input) {
  const MetricGroup& tree = input.metrics;
  const std::int64_t offset = tree.count("input/disparity_offset");
  std::string html = fmt::format(
      "<h1>Stereo pipeline, {} x {} px, disparities {} to {}</h1>\n"
      "<p class=\"soft\">Preset {}, {} frames in time, {} of them with images</p>\n",
      tree.count("input/width"), tree.count("input/height"), offset,
      offset + tree.count("input/disparity_range") - 1, escaped(input.configuration.value("preset", "")),
      tree.count("input/frames"), tree.count("input/frames_with_images"));
  html += verdict_banner(tree);
  html += "<div class=\"cards\">\n";
  if (tree.number_or("performance/frame_rate", 0) > 0) {
    html += card(number_text(tree.number("performance/frame_rate"), 2) + " fps",
                 metric_term(tree, "performance/frame_rate", "frame rate"));
    html += per_second(tree, "performance/evaluations_per_second", 1e9, "billion/s", "disparity evaluations");
    html += per_second(tree, "performance/disparities_per_second", 1e6, "million/s", "disparities");
  }
  html += card(tree, "latency/first_pixel_first_frame", "first pixel, first frame");
  html += card(tree, "latency/last_pixel_first_frame", "last pixel, first frame");
  html += card(tree, "latency/exposure_to_host_mean", "exposure to host, mean");
  if (tree.find("memory/bandwidth") != nullptr) {
    html += card(fmt::format("{} of {} MB/s", number_text(tree.number("memory/bandwidth"), 0),
                             number_text(tree.number_or("memory/usable_bandwidth", 0), 0)),
                 metric_term(tree, "memory/bandwidth", "memory bandwidth"));
  }
  if (tree.find("energy/power_total") != nullptr) {
    html += card(number_text(tree.number("energy/power_total"), 2) + " W",
                 metric_term(tree, "energy/power_total", "power, an estimate"));
  }
  if (const MetricGroup* const quality = tree.find_group("quality")) {
    for (const Metric& metric : quality->metrics) {
      if (metric.name == "coverage" || metric.name.rfind("bad_3", 0) == 0 || metric.name == "mean_error")
        html += card(metric_text(metric), metric_term(*quality, metric.name, words(metric.name)));
    }
  }
  return html + "</div>\n";
}

std::string images_section(const ReportInput& input) {
  std::string figures;
  for (const ReportImage& image : input.images) {
    figures +=
        fmt::format("<figure><img src=\"{}\" alt=\"{}\"><figcaption><b>{}</b>{}{}</figcaption></figure>\n",
                    data_uri(image.type, image.bytes), escaped(image.title), escaped(image.title),
                    image.caption.empty() ? "" : ". ", escaped(image.caption));
  }
  return figures.empty() ? "" : "<div class=\"figures\">\n" + figures + "</div>\n";
}

std::string budget_section(const ReportInput& input) {
  Table table(
      "What has been published of this machine, and what this run reaches; pass: as near as the row asks. A "
      "row of another size or range "
      "says nothing about this run; parallax validate runs them all.",
      {"published for", "figure", "published", "this run", "deviation", "verdict", "source"}, "words");
  for (const BudgetLine& line : input.budget) {
    std::vector<std::string> cells = {escaped(line.name), escaped(words(line.metric)),
                                      large_number(line.published, line.unit)};
    if (line.reached) {
      cells.push_back(large_number(*line.reached, line.unit));
      cells.push_back(fmt::format("{:+.2f} %", line.deviation));
      cells.push_back(line.within ? "<span class=\"pass\">pass</span>" : "<span class=\"fail\">fail</span>");
    } else {
      cells.insert(cells.end(), {"", "", "<span class=\"soft\">another size or range</span>"});
    }
    cells.push_back(escaped(line.source));
    table.row(cells);
  }
  return table.empty() ? "" : table.html();
}

}  // namespace parallax
