// SPDX-License-Identifier: Apache-2.0
#include "platform/report/comparison_page.hpp"

#include <fmt/format.h>

#include <vector>

#include "traces/metric_text.hpp"
#include "traces/report/html.hpp"
#include "traces/report/report_page.hpp"

namespace parallax {
namespace {

using Json = nlohmann::ordered_json;

std::string table_of(const std::vector<RunComparison::Difference>& differences, const MetricGroup& a,
                     const MetricGroup& b) {
  Table table("", {"number", "A", "B", "change"});
  for (const RunComparison::Difference& d : differences) {
    const Metric* const metric = a.find(d.name) != nullptr ? a.find(d.name) : b.find(d.name);
    table.row({term(d.name, metric_meaning(metric)), escaped(d.text_a()), escaped(d.text_b()),
               escaped(d.change_text())});
  }
  return table.html();
}

// How busy the stages of both are, for the chart.
Json stages_of(const MetricGroup& a, const MetricGroup& b) {
  Json stages{{"names", Json::array()}, {"a", Json::array()}, {"b", Json::array()}};
  for (const MetricGroup& stage : a.group_at("stages").groups) {
    const MetricGroup* const same = b.group_at("stages").find_group(stage.name);
    if (same == nullptr) continue;
    stages["names"].push_back(stage.name);
    stages["a"].push_back(stage.number("utilisation"));
    stages["b"].push_back(same->number("utilisation"));
  }
  return stages;
}

std::string sentence(const char* name, const RunReport& report) {
  const std::string verdict = report.metrics.word_or("limit/verdict", "");
  const std::string stuck = report.metrics.word_or("deadlock/remedy", "");
  return fmt::format(
      "<p><b>{}</b>: {}<br><code>{}</code>{}</p>\n", name, escaped(report.path),
      escaped(report.metrics.word_or("run/command", "")),
      stuck.empty() ? verdict.empty() ? "" : "<br>" + escaped(verdict) : "<br>stuck: " + escaped(stuck));
}

}  // namespace

std::string comparison_page(const RunComparison& comparison, const RunReport& a, const RunReport& b) {
  std::string navigation, body;
  const auto add = [&](const std::string& id, const std::string& title, const std::string& content) {
    navigation += fmt::format("<a href=\"#{}\">{}</a>\n", id, escaped(title));
    body += section(id, title, content);
  };
  std::size_t number = 0;
  for (const ComparisonSection& part : sections(comparison)) {
    const std::string content = part.differences.empty() ? "<p>no difference</p>\n"
                                                         : table_of(part.differences, a.metrics, b.metrics);
    add(fmt::format("part-{}", ++number), part.title, content);
  }
  add("busy", "how busy the stages are",
      canvas("chart-comparison", "How busy each stage is in A and B", true));
  add("all", "every number that changed",
      "<details><summary>As a table</summary>\n" + table_of(comparison.results, a.metrics, b.metrics) +
          "</details>\n");
  return html_page(
      "Parallax: two runs",
      fmt::format("<a class=\"skip\" href=\"#top\">To the content</a>\n"
                  "<nav aria-label=\"Parts of the page\">\n{}"
                  "<button class=\"theme script-only\" type=\"button\">dark or light</button></nav>\n"
                  "<main id=\"top\">\n<h1>What changed from A to B</h1>\n{}{}{}</main>\n",
                  navigation, sentence("A", a), sentence("B", b), body),
      Json{{"comparison", stages_of(a.metrics, b.metrics)}});
}

}  // namespace parallax
