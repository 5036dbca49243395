// SPDX-License-Identifier: Apache-2.0
// What a reader looks at first: figures, images, and whether it is what was published.
#include <fmt/format.h>

#include "traces/report/html.hpp"
#include "traces/report/metric_text.hpp"
#include "traces/report/sections.hpp"

namespace parallax {
namespace {

using Json = nlohmann::ordered_json;

std::string card(const std::string& value, const std::string& name) {
  return fmt::format("<div class=\"card\"><div class=\"value\">{}</div><div class=\"name\">{}</div></div>\n",
                     escaped(value), name);
}

std::string card(const Json& tree, const char* path, const char* name) {
  const Json* const metric = find_metric(tree, path);
  return metric == nullptr ? "" : card(metric_text(*metric), metric_term(tree, path, name));
}

std::string large_number(double value, const std::string& unit) {
  if (value >= 1e9) return escaped(fmt::format("{:.3g} billion {}", value / 1e9, unit));
  if (value >= 1e6) return escaped(fmt::format("{:.3g} million {}", value / 1e6, unit));
  return escaped(fmt::format("{:.5g} {}", value, unit));
}

std::string per_second(const Json& tree, const char* path, double unit, const char* unit_name,
                       const char* name) {
  if (find_metric(tree, path) == nullptr) return "";
  return card(number_text(metric_number(tree, path) / unit, 2) + " " + unit_name,
              metric_term(tree, path, name));
}

std::string stuck_banner(const Json& tree) {
  std::string waits;
  for (const auto& [name, wait] : tree.at("deadlock").items()) {
    if (is_metric(wait)) continue;
    waits += fmt::format("<li>{} waits on stream <b>{}</b> ({}, depth {}) for {}</li>\n",
                         escaped(metric_word(wait, "waiter")), escaped(metric_word(wait, "stream")),
                         escaped(metric_word(wait, "state")), metric_number(wait, "depth"),
                         escaped(metric_word(wait, "waits_for")));
  }
  return fmt::format(
      "<div class=\"verdict stuck\" role=\"alert\"><b>The machine got stuck</b> before the host had all "
      "frames.\n<ol>{}</ol>\n<b>Remedy:</b> {}</div>\n",
      waits, escaped(metric_word(tree, "deadlock/remedy")));
}

std::string verdict_banner(const Json& tree) {
  if (tree.contains("deadlock")) return stuck_banner(tree);
  std::string sentence = metric_word(tree, "limit/verdict");
  if (sentence.empty() && find_metric(tree, "limit/part") != nullptr) {
    sentence = fmt::format("{} at {:.1f} % of the time", metric_word(tree, "limit/part"),
                           metric_number(tree, "limit/utilisation"));
  }
  return sentence.empty() ? "" : fmt::format("<p class=\"verdict\">{}</p>\n", escaped(sentence));
}

}  // namespace

std::string overview(const ReportInput& input) {
  const Json& tree = input.timing;
  std::string html = fmt::format(
      "<h1>Stereo pipeline, {:.0f} x {:.0f} px, disparities {:.0f} to {:.0f}</h1>\n"
      "<p class=\"soft\">Preset {}, {:.0f} frames in time, {:.0f} of them with images</p>\n",
      metric_number(tree, "input/width"), metric_number(tree, "input/height"),
      metric_number(tree, "input/disparity_offset"),
      metric_number(tree, "input/disparity_offset") + metric_number(tree, "input/disparity_range") - 1,
      escaped(tree.at("configuration").value("preset", "")), metric_number(tree, "input/frames"),
      metric_number(tree, "input/frames_with_images"));
  html += verdict_banner(tree);
  html += "<div class=\"cards\">\n";
  if (metric_number(tree, "performance/frame_rate") > 0) {
    html += card(number_text(metric_number(tree, "performance/frame_rate"), 2) + " fps",
                 metric_term(tree, "performance/frame_rate", "frame rate"));
    html += per_second(tree, "performance/evaluations_per_second", 1e9, "billion/s", "disparity evaluations");
    html += per_second(tree, "performance/disparities_per_second", 1e6, "million/s", "disparities");
  }
  html += card(tree, "latency/first_pixel_first_frame", "first pixel, first frame");
  html += card(tree, "latency/last_pixel_first_frame", "last pixel, first frame");
  html += card(tree, "latency/exposure_to_host_mean", "exposure to host, mean");
  if (find_metric(tree, "memory/bandwidth") != nullptr) {
    html += card(fmt::format("{} of {} MB/s", number_text(metric_number(tree, "memory/bandwidth"), 0),
                             number_text(metric_number(tree, "memory/usable_bandwidth"), 0)),
                 metric_term(tree, "memory/bandwidth", "memory bandwidth"));
  }
  if (find_metric(tree, "energy/power_total") != nullptr) {
    html += card(number_text(metric_number(tree, "energy/power_total"), 2) + " W",
                 metric_term(tree, "energy/power_total", "power, an estimate"));
  }
  if (tree.contains("quality")) {
    for (const auto& [name, metric] : tree.at("quality").items()) {
      if (is_metric(metric) &&
          (name == "density" || name == "coverage" || name.rfind("bad_3", 0) == 0 || name == "mean_error"))
        html += card(metric_text(metric), metric_term(tree, "quality/" + name, words(name)));
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
      "What has been published of this machine, and what this run reaches. A row of another size or range "
      "says nothing about this run; parallax validate runs them all.",
      {"published for", "figure", "published", "this run", "deviation", "verdict", "source"}, "words");
  for (const BudgetLine& line : input.budget) {
    std::vector<std::string> cells = {escaped(line.name), escaped(words(line.metric)),
                                      large_number(line.published, line.unit)};
    if (line.reached) {
      // Of time and power less is better, of all else more.
      const bool less = line.unit == "ms" || line.unit == "W";
      const bool pass = less ? *line.reached <= line.published : *line.reached >= line.published;
      cells.push_back(large_number(*line.reached, line.unit));
      cells.push_back(fmt::format("{:+.2f} %", 100 * (*line.reached / line.published - 1)));
      cells.push_back(pass ? "<span class=\"pass\">pass</span>" : "<span class=\"fail\">fail</span>");
    } else {
      cells.insert(cells.end(), {"", "", "<span class=\"soft\">another size or range</span>"});
    }
    cells.push_back(escaped(line.source));
    table.row(cells);
  }
  return table.empty() ? "" : table.html();
}

}  // namespace parallax
