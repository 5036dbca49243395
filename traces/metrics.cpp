// SPDX-License-Identifier: Apache-2.0
#include "traces/metrics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace parallax {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
const T* named(const std::vector<T>& list, std::string_view name) {
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const T& entry) { return entry.name == name; });
  return found == list.end() ? nullptr : &*found;
}

template <class T>
const T& value_as(const Metric& metric, const char* kind) {
  if (const T* const value = std::get_if<T>(&metric.value)) return *value;
  throw MetricError(fmt::format("{} is no {}", metric.name, kind));
}

// A metric's own error names the metric alone; who looked for it knows the path.
template <class Read>
auto read_at(const MetricGroup& group, std::string_view path, const Read& read) -> decltype(read(Metric{})) {
  const Metric& metric = group.at(path);
  try {
    return read(metric);
  } catch (const MetricError& error) {
    const std::size_t slash = path.rfind('/');
    if (slash == std::string_view::npos) throw;
    throw MetricError(fmt::format("{}{}", path.substr(0, slash + 1), error.what()));
  }
}

std::string text_of(const Json& entry, const char* key) {
  const auto found = entry.find(key);
  if (found == entry.end()) return "";
  if (!found->is_string()) throw MetricError(fmt::format("its {} is no text", key));
  return found->get<std::string>();
}

void read_value(const Json& value, Metric& metric) {
  if (value.is_number_integer()) {
    metric.value = value.get<std::int64_t>();
  } else if (value.is_number()) {
    metric.value = value.get<double>();
  } else if (value.is_null()) {
    metric.value = std::numeric_limits<double>::quiet_NaN();
  } else if (value.is_string()) {
    metric.value = value.get<std::string>();
  } else if (value.is_boolean()) {
    metric.value = value.get<bool>();
  } else if (value.is_array() && std::all_of(value.begin(), value.end(),
                                             [](const Json& each) { return each.is_number_integer(); })) {
    metric.value = value.get<std::vector<std::int64_t>>();
  } else {
    throw MetricError("its value is neither number nor text");
  }
}

Metric metric_of(const std::string& name, const Json& entry) {
  if (!entry.contains("value")) throw MetricError("it has no value");
  if (!entry.contains("unit")) throw MetricError("it has no unit");
  Metric metric{name, {}, text_of(entry, "unit"), text_of(entry, "description"), text_of(entry, "window")};
  read_value(entry.at("value"), metric);
  if (!metric.unit.empty() && std::holds_alternative<std::string>(metric.value))
    throw MetricError(fmt::format("its value is a text, and a number of {} is expected", metric.unit));
  return metric;
}

MetricGroup group_of(const std::string& name, const std::string& path, const Json& tree) {
  MetricGroup group{name, {}, {}};
  for (const auto& [key, entry] : tree.items()) {
    if (!entry.is_object()) continue;
    const std::string here = path.empty() ? key : fmt::format("{}/{}", path, key);
    // A group's own children are objects; whatever else stands under one of these names is a metric's.
    const auto is_own = [&entry = entry](const char* part) {
      return entry.contains(part) && !entry.at(part).is_object();
    };
    if (!is_own("value") && !is_own("unit")) {
      group.groups.push_back(group_of(key, here, entry));
      continue;
    }
    try {
      group.metrics.push_back(metric_of(key, entry));
    } catch (const MetricError& error) {
      throw MetricError(fmt::format("{} is no metric: {}", here, error.what()));
    }
  }
  return group;
}

}  // namespace

bool Metric::is_number() const {
  return std::holds_alternative<std::int64_t>(value) || std::holds_alternative<double>(value);
}

double Metric::number() const {
  if (const auto* const whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  return value_as<double>(*this, "number");
}

std::int64_t Metric::count() const { return value_as<std::int64_t>(*this, "whole number"); }

const std::string& Metric::word() const { return value_as<std::string>(*this, "text"); }

MetricGroup& MetricGroup::group(const std::string& group_name) {
  const auto found =
      std::find_if(groups.begin(), groups.end(), [&](const MetricGroup& g) { return g.name == group_name; });
  if (found != groups.end()) return *found;
  groups.push_back({group_name, {}, {}});
  return groups.back();
}

const MetricGroup* MetricGroup::find_group(std::string_view path) const {
  const std::size_t slash = path.find('/');
  const MetricGroup* const child = named(groups, path.substr(0, slash));
  if (child == nullptr || slash == std::string_view::npos) return child;
  return child->find_group(path.substr(slash + 1));
}

const Metric* MetricGroup::find(std::string_view path) const {
  const std::size_t slash = path.rfind('/');
  if (slash == std::string_view::npos) return named(metrics, path);
  const MetricGroup* const parent = find_group(path.substr(0, slash));
  return parent == nullptr ? nullptr : named(parent->metrics, path.substr(slash + 1));
}

const Metric& MetricGroup::at(std::string_view path) const {
  if (const Metric* const metric = find(path)) return *metric;
  throw MetricError(fmt::format("it has no {}", path));
}

const MetricGroup& MetricGroup::group_at(std::string_view path) const {
  if (const MetricGroup* const found = find_group(path)) return *found;
  throw MetricError(fmt::format("it has no {}", path));
}

double MetricGroup::number(std::string_view path) const {
  return read_at(*this, path, [](const Metric& metric) { return metric.number(); });
}

std::int64_t MetricGroup::count(std::string_view path) const {
  return read_at(*this, path, [](const Metric& metric) { return metric.count(); });
}

const std::string& MetricGroup::word(std::string_view path) const {
  return read_at(*this, path, [](const Metric& metric) -> const std::string& { return metric.word(); });
}

double MetricGroup::number_or(std::string_view path, double otherwise) const {
  return find(path) == nullptr ? otherwise : number(path);
}

std::string MetricGroup::word_or(std::string_view path, const std::string& otherwise) const {
  return find(path) == nullptr ? otherwise : word(path);
}

Json to_json(const Metric& metric) {
  Json entry;
  std::visit([&entry](const auto& value) { entry["value"] = value; }, metric.value);
  entry["unit"] = metric.unit;
  entry["description"] = metric.description;
  if (!metric.window.empty()) entry["window"] = metric.window;
  return entry;
}

Json to_json(const MetricGroup& group) {
  auto tree = Json::object();
  for (const Metric& metric : group.metrics) tree[metric.name] = to_json(metric);
  for (const MetricGroup& child : group.groups) tree[child.name] = to_json(child);
  return tree;
}

MetricGroup metrics_of(const Json& tree) { return group_of("", "", tree); }

}  // namespace parallax
