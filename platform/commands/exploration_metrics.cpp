// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/exploration_metrics.hpp"

#include <fmt/format.h>

#include <vector>

#include "platform/config/nearest_key.hpp"
#include "platform/estimate/estimate_metrics.hpp"
#include "platform/results/glossary.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

// Where the numbers of a device are.
std::string device_path(const std::string& device) { return "devices/" + device_group(device) + "/"; }

}  // namespace

const MetricInfo& require_metric(const std::string& name, const std::string& where) {
  if (name.rfind("quality/", 0) == 0)
    throw UserError(fmt::format("{}: {} needs images, and none are computed", where, excerpt(name)));
  if (const MetricInfo* metric = find_run_metric(name)) return *metric;
  if (const MetricInfo* metric = find_estimate_metric(name)) return *metric;
  std::vector<std::string> names = run_metric_names();
  for (const MetricInfo& row : estimate_table().rows()) names.push_back(row.path);
  throw UserError(
      fmt::format("{}: no number of a run or an estimate is called {}, and no key that varies; the nearest "
                  "is {} (parallax glossary)",
                  where, excerpt(name), nearest_key(name, names)));
}

void require_number(const std::string& name, const std::string& device, const std::string& where) {
  const MetricInfo& metric = require_metric(name, where);
  const bool of_device = metric.path.rfind("devices/", 0) == 0;
  if (of_device && name.rfind(device_path(device), 0) != 0)
    throw UserError(device.empty()
                        ? fmt::format("{}: {} needs a device, and none is named", where, excerpt(name))
                        : fmt::format("{}: {} is not of the device that is named: {}", where, excerpt(name),
                                      excerpt(device)));
  if (metric.unit.empty() && !of_device)
    throw UserError(fmt::format("{}: {} is a word, and has no least or most", where, excerpt(name)));
}

}  // namespace parallax
