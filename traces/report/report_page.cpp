// SPDX-License-Identifier: Apache-2.0
#include "traces/report/report_page.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "traces/json_text.hpp"
#include "traces/report/assets.hpp"
#include "traces/report/html.hpp"
#include "traces/report/page_text.hpp"
#include "traces/report/sections.hpp"

namespace parallax {
namespace {

using Json = nlohmann::ordered_json;

struct Part {
  std::string_view id;
  std::string_view title;
  std::string (*make)(const ReportInput&);
};

constexpr std::array<Part, 12> kParts = {{{"images", "Images", images_section},
                                          {"pipeline", "Pipeline", pipeline_section},
                                          {"stages", "Stages", stages_section},
                                          {"fifos", "FIFOs", fifos_section},
                                          {"memory", "Memory", memory_section},
                                          {"latency", "Latency", latency_section},
                                          {"limits", "Limits", limits_section},
                                          {"budget", "Published figures", budget_section},
                                          {"energy", "Energy", energy_section},
                                          {"storage", "On-chip memory", storage_section},
                                          {"numbers", "All numbers", numbers_section},
                                          {"configuration", "Configuration", configuration_section}}};

// A script element ends at the first "</script", whatever quotes it stands in, and "<!--" begins another
// syntax: no character that means something in HTML is left. They stand within texts only, where JSON allows
// to write them so; the two of three bytes end a line of JavaScript.
std::string script_safe(const std::string& json) {
  std::string text;
  for (std::size_t at = 0; at < json.size(); ++at) {
    const char c = json[at];
    const std::string three = json.substr(at, 3);
    if (c == '<' || c == '>' || c == '&') {
      text += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else if (three == "\xE2\x80\xA8" || three == "\xE2\x80\xA9") {
      text += three.back() == '\xA8' ? "\\u2028" : "\\u2029";
      at += 2;
    } else {
      text += c;
    }
  }
  return text;
}

// What a click shows of a stage and of the FIFOs beside it: numbers are rounded here, and nowhere else.
Json texts_of(const MetricGroup& tree) {
  Json texts{{"stages", Json::object()}, {"held", Json::object()}};
  for (const MetricGroup& stage : tree.group_at("stages").groups) {
    for (const Metric& metric : stage.metrics) texts["stages"][stage.name][metric.name] = plain_text(metric);
  }
  for (const MetricGroup& stream : tree.group_at("streams").groups)
    texts["held"][stream.name] =
        page_number(stream.at("mean_occupancy")) + " of " + page_number(stream.at("depth"));
  return texts;
}

}  // namespace

std::string html_page(const std::string& title, const std::string& body, const Json& data) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n{}"
      "<script type=\"application/json\" "
      "id=\"data\">{}</script>\n<script>{}</script>\n<script>\n{}</script>\n"
      "</body>\n</html>\n",
      escaped(title), kReportStyle, body, script_safe(json_text(data)), kChartLibrary, kReportScript);
}

std::string report_page(const ReportInput& input) {
  const MetricGroup& tree = input.metrics;
  std::string navigation, sections;
  for (const Part& part : kParts) {
    const std::string html = part.make(input);
    if (html.empty()) continue;
    navigation += fmt::format("<a href=\"#{}\">{}</a>\n", part.id, part.title);
    sections += section(part.id, part.title, html);
  }
  Json data;
  for (const char* group : {"stages", "streams", "energy"}) {
    if (const MetricGroup* const found = tree.find_group(group)) data[group] = to_json(*found);
  }
  data["texts"] = texts_of(tree);
  if (!input.profile.is_null()) data["profile"] = input.profile;
  if (!input.relaxations.is_null()) data["relaxations"] = input.relaxations;
  const std::string body = fmt::format(
      "<a class=\"skip\" href=\"#top\">To the content</a>\n"
      "<nav aria-label=\"Parts of the report\">\n{}"
      "<button class=\"theme script-only\" type=\"button\">dark or light</button></nav>\n"
      "<main id=\"top\">\n{}{}</main>\n"
      "<footer>Written by Parallax {} ({}). A number's meaning shows when the pointer rests on it, and in "
      "the "
      "table of all numbers. Charts: Chart.js, MIT licence.</footer>\n",
      navigation, overview(input), sections, escaped(tree.word_or("run/version", "")),
      escaped(tree.word_or("run/revision", "")));
  return html_page(fmt::format("Parallax: {} x {}, {}", tree.count("input/width"), tree.count("input/height"),
                               input.configuration.value("preset", "")),
                   body, data);
}

}  // namespace parallax
