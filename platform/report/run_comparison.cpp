// SPDX-License-Identifier: Apache-2.0
#include "platform/report/run_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "traces/json_text.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

using Json = nlohmann::ordered_json;
using Difference = RunComparison::Difference;

struct Leaf {
  Json value;
  std::string unit;
};
using Leaves = std::vector<std::pair<std::string, Leaf>>;

void gather_keys(const Json& tree, const std::string& path, Leaves& leaves) {
  for (const auto& [name, child] : tree.items()) {
    if (child.is_object()) {
      gather_keys(child, path + name + "/", leaves);
    } else {
      leaves.push_back({path + name, {child, ""}});
    }
  }
}

void gather_metrics(const MetricGroup& group, const std::string& path, Leaves& leaves) {
  for (const Metric& metric : group.metrics)
    leaves.push_back({path + metric.name, {to_json(metric).at("value"), metric.unit}});
  for (const MetricGroup& child : group.groups) gather_metrics(child, path + child.name + "/", leaves);
}

// All but those of this computer, and what follows from the configuration.
Leaves results_of(const RunReport& report) {
  Leaves leaves;
  gather_metrics(report.metrics, "", leaves);
  const auto left_out = [](const auto& leaf) {
    return leaf.first.rfind("run/", 0) == 0 || leaf.first.rfind("schema/", 0) == 0;
  };
  leaves.erase(std::remove_if(leaves.begin(), leaves.end(), left_out), leaves.end());
  return leaves;
}

Leaves configuration_of(const RunReport& report) {
  Leaves leaves;
  gather_keys(report.configuration, "", leaves);
  return leaves;
}

// In the order of the first, what only the second has after it.
std::vector<Difference> differences(const Leaves& a, const Leaves& b) {
  std::map<std::string, const Leaf*> of_b;
  for (const auto& [name, leaf] : b) of_b[name] = &leaf;
  std::vector<Difference> all;
  for (const auto& [name, leaf] : a) {
    const auto found = of_b.find(name);
    if (found == of_b.end()) {
      all.push_back({name, leaf.value, nullptr, leaf.unit});
      continue;
    }
    if (found->second->value != leaf.value)
      all.push_back({name, leaf.value, found->second->value, leaf.unit});
    of_b.erase(found);
  }
  for (const auto& [name, leaf] : b) {
    if (of_b.count(name) > 0) all.push_back({name, nullptr, leaf.value, leaf.unit});
  }
  return all;
}

// Values of the configuration have no unit here, and all their digits.
std::string text_of(const Json& value, const std::string& unit) {
  if (value.is_null()) return "-";
  if (value.is_number_float() && !unit.empty()) return quantity_text(value.get<double>(), unit);
  std::string text = value.is_string() ? value.get<std::string>() : json_text(value);
  constexpr std::size_t kLongest = 40;
  if (text.size() > kLongest) text = text.substr(0, kLongest - 3) + "...";
  return unit.empty() ? text : text + " " + unit;
}

// Two numbers that differ are not said to be the same.
std::string text_beside(const Json& value, const Json& other, const std::string& unit) {
  std::string text = text_of(value, unit);
  const bool says_same = value.is_number_float() && text == text_of(other, unit);
  return says_same ? with_unit(json_text(value), unit) : text;
}

std::string line(const Difference& d) {
  const std::string change = d.change_text();
  return fmt::format("  {:<44} {:>22} {:>22}{}\n", d.name, d.text_a(), d.text_b(),
                     change.empty() ? "" : fmt::format(" {:>10}", change));
}

// What a person asks first.
bool is_headline(const std::string& name) {
  for (const char* prefix : {"input/", "performance/", "limit/", "quality/"}) {
    if (name.rfind(prefix, 0) == 0 && name.find("utilisation_by_part") == std::string::npos) return true;
  }
  for (const char* wanted :
       {"latency/first_pixel_mean", "latency/last_pixel_mean", "latency/exposure_to_host_mean",
        "latency/exposure_to_host_p99", "camera/dropped_frames", "camera/faulty_frames",
        "camera/missed_triggers", "memory/bandwidth", "memory/usable_bandwidth", "memory/at_work",
        "memory/share", "memory/row_hits", "energy/power_total", "energy/frame_total"}) {
    if (name == wanted) return true;
  }
  return false;
}

bool matches(const std::string& name, const std::string& group, std::initializer_list<const char*> metrics) {
  if (name.rfind(group, 0) != 0) return false;
  const std::string metric = name.substr(name.rfind('/') + 1);
  return std::any_of(metrics.begin(), metrics.end(), [&](const char* wanted) { return metric == wanted; });
}

bool is_of_stage(const std::string& name) {
  return matches(name, "stages/", {"utilisation", "starved_share", "blocked_share", "memory_share"});
}

bool is_of_port(const std::string& name) {
  return std::count(name.begin(), name.end(), '/') == 2 &&
         matches(name, "memory/", {"bandwidth", "latency_mean", "stalls"});
}

// By a point, or by a percent.
bool is_noticeable(const Difference& d) {
  if (!d.a.is_number() || !d.b.is_number()) return true;
  const std::optional<double> percent = d.change();
  return std::abs(percent.value_or(d.b.get<double>() - d.a.get<double>())) >= 1;
}

Json to_json(const std::vector<Difference>& all) {
  auto list = Json::array();
  for (const Difference& d : all) {
    Json entry{{"name", d.name}, {"a", d.a}, {"b", d.b}, {"unit", d.unit}};
    if (const auto percent = d.change()) entry["change_percent"] = *percent;
    list.push_back(std::move(entry));
  }
  return list;
}

}  // namespace

RunComparison compare(const RunReport& a, const RunReport& b) {
  RunComparison comparison{a.path, b.path, {}, {}};
  comparison.configuration = differences(configuration_of(a), configuration_of(b));
  comparison.results = differences(results_of(a), results_of(b));
  return comparison;
}

nlohmann::ordered_json to_json(const RunComparison& comparison) {
  return {{"a", comparison.path_a},
          {"b", comparison.path_b},
          {"configuration", to_json(comparison.configuration)},
          {"results", to_json(comparison.results)}};
}

std::vector<ComparisonSection> sections(const RunComparison& comparison) {
  const auto chosen = [&](const char* title, const auto& wanted) {
    ComparisonSection section{title, {}};
    std::copy_if(comparison.results.begin(), comparison.results.end(),
                 std::back_inserter(section.differences), wanted);
    return section;
  };
  return {{"configuration", comparison.configuration},
          chosen("results", [](const Difference& d) { return is_headline(d.name); }),
          chosen("stages, by a point or more",
                 [](const Difference& d) { return is_of_stage(d.name) && is_noticeable(d); }),
          chosen("memory ports, by a percent or more",
                 [](const Difference& d) { return is_of_port(d.name) && is_noticeable(d); })};
}

std::string to_text(const RunComparison& comparison, bool all) {
  if (comparison.configuration.empty() && comparison.results.empty()) return "no difference\n";
  std::string text = fmt::format("  {:<44} {:>22} {:>22}\n", "", "A", "B");
  const auto add = [&](const ComparisonSection& section) {
    if (!section.differences.empty()) text += section.title + "\n";
    for (const Difference& d : section.differences) text += line(d);
  };
  if (all) {
    add({"configuration", comparison.configuration});
    add({"results", comparison.results});
  } else {
    for (const ComparisonSection& section : sections(comparison)) add(section);
  }
  return text;
}

std::optional<double> RunComparison::Difference::change() const {
  if (!a.is_number() || !b.is_number() || unit == "%" || a.get<double>() == 0) return std::nullopt;
  return 100 * (b.get<double>() / a.get<double>() - 1);
}

std::string RunComparison::Difference::change_text() const {
  const std::optional<double> percent = change();
  return percent ? parallax::change_text(*percent, "%") + " %" : "";
}

std::string RunComparison::Difference::text_a() const { return text_beside(a, b, unit); }
std::string RunComparison::Difference::text_b() const { return text_beside(b, a, unit); }

}  // namespace parallax
