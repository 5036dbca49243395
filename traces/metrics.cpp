// SPDX-License-Identifier: Apache-2.0
#include "traces/metrics.hpp"

#include <algorithm>
#include <stdexcept>

namespace parallax {

MetricGroup& MetricGroup::group(const std::string& group_name) {
  const auto found =
      std::find_if(groups.begin(), groups.end(), [&](const MetricGroup& g) { return g.name == group_name; });
  if (found != groups.end()) return *found;
  groups.push_back({group_name, {}, {}});
  return groups.back();
}

const Metric* MetricGroup::find(const std::string& path) const {
  const std::size_t slash = path.find('/');
  if (slash != std::string::npos) {
    for (const MetricGroup& child : groups) {
      if (child.name == path.substr(0, slash)) return child.find(path.substr(slash + 1));
    }
  } else {
    for (const Metric& metric : metrics) {
      if (metric.name == path) return &metric;
    }
  }
  return nullptr;
}

const Metric& MetricGroup::at(const std::string& path) const {
  if (const Metric* metric = find(path)) return *metric;
  throw std::out_of_range("no metric " + path);
}

nlohmann::ordered_json to_json(const MetricGroup& group) {
  auto tree = nlohmann::ordered_json::object();
  for (const Metric& metric : group.metrics) {
    auto& entry = tree[metric.name];
    std::visit([&entry](const auto& value) { entry["value"] = value; }, metric.value);
    entry["unit"] = metric.unit;
    entry["description"] = metric.description;
    if (!metric.window.empty()) entry["window"] = metric.window;
  }
  for (const MetricGroup& child : group.groups) tree[child.name] = to_json(child);
  return tree;
}

}  // namespace parallax
