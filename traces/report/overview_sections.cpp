// SPDX-License-Identifier: Apache-2.0
// What a reader looks at first: figures, images, and whether it is what was published.
#include <fmt/format.h>

#include "traces/metric_text.hpp"
#include "traces/number_text.hpp"
#include "traces/report/html.hpp"
#include "traces/report/page_text.hpp"
#include "traces/report/sections.hpp"

namespace parallax {
namespace {

std::string card(const std::string& value, const std::string& name) {
  return fmt::format("<div class=\"card\"><div class=\"value\">{}</div><div class=\"name\">{}</div></div>\n",
                     value, name);
}

std::string card(const MetricGroup& tree, const std::string& path, const std::string& name) {
  const std::string value = page_text(tree, path);
  return value.empty() ? "" : card(value, metric_term(tree, path, name));
}

std::string stuck_banner(const MetricGroup& deadlock) {
  std::string waits;
  for (const MetricGroup& wait : deadlock.groups) {
    waits += fmt::format("<li>{} waits on stream <b>{}</b> ({}, depth {}) for {}</li>\n",
                         escaped(wait.word("waiter")), escaped(wait.word("stream")),
                         escaped(wait.word("state")), wait.count("depth"), escaped(wait.word("waits_for")));
  }
  return fmt::format(
      "<div class=\"verdict stuck\" role=\"alert\"><b>The machine got stuck</b> before all frames were "
      "done.\n<ol>{}</ol>\n<b>Remedy:</b> {}</div>\n",
      waits, escaped(deadlock.word("remedy")));
}

std::string verdict_banner(const MetricGroup& tree) {
  if (const MetricGroup* const deadlock = tree.find_group("deadlock")) return stuck_banner(*deadlock);
  std::string sentence = tree.word_or("limit/verdict", "");
  if (sentence.empty() && tree.find("limit/part") != nullptr) {
    sentence = filled_in(tree, tree.word("limit/part") == "none"
                                   ? "no part is at work all the time; the busiest, {limit/next_part}, is at "
                                     "{limit/utilisation}"
                                   : "{limit/part} at {limit/utilisation} of the time");
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
    html += card(tree, "performance/frame_rate", "frame rate");
    html += card(tree, "performance/evaluations_per_second", "disparity evaluations");
    html += card(tree, "performance/disparities_per_second", "disparities");
  }
  html += card(tree, "latency/first_pixel_first_frame", "first pixel, first frame");
  html += card(tree, "latency/last_pixel_first_frame", "last pixel, first frame");
  html += card(tree, "latency/exposure_to_host_mean", "exposure to " + end_of_way(tree) + ", mean");
  if (tree.find("memory/bandwidth") != nullptr) {
    const std::string usable = page_text(tree, "memory/usable_bandwidth");
    html += card(usable.empty() ? page_text(tree, "memory/bandwidth")
                                : page_number(tree, "memory/bandwidth") + " of " + usable,
                 metric_term(tree, "memory/bandwidth", "memory bandwidth"));
  }
  html += card(tree, "energy/power_total", "power, an estimate");
  if (const MetricGroup* const quality = tree.find_group("quality")) {
    for (const Metric& metric : quality->metrics) {
      if (metric.name == "coverage" || metric.name.rfind("bad_3", 0) == 0 || metric.name == "mean_error")
        html += card(*quality, metric.name, words(metric.name));
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
                                      escaped(with_unit(stated_text(line.published, line.unit), line.unit))};
    if (line.reached) {
      cells.push_back(escaped(with_unit(page_number(*line.reached, line.unit), line.unit)));
      cells.push_back(change_text(line.deviation, "%") + " %");
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
