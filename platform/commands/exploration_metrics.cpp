// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/exploration_metrics.hpp"

#include <fmt/format.h>

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
    throw UserError(fmt::format("{}: {} needs images, and explorations compute none", where, excerpt(name)));
  if (const MetricInfo* metric = find_run_metric(name)) return *metric;
  if (const MetricInfo* metric = find_estimate_metric(name)) return *metric;
  throw UserError(fmt::format(
      "{}: {} is neither varied nor a number of a run; the nearest of these is {} (parallax glossary)", where,
      excerpt(name), nearest_key(name, run_metric_names())));
}

void require_number(const std::string& name, const std::string& device, const std::string& where) {
  const MetricInfo& metric = require_metric(name, where);
  const bool of_device = metric.path.rfind("devices/", 0) == 0;
  if (of_device && name.rfind(device_path(device), 0) != 0)
    throw UserError(fmt::format("{}: {} is not of the device that the file names: device = \"{}\"", where,
                                excerpt(name), device));
  if (metric.unit.empty() && !of_device)
    throw UserError(fmt::format("{}: {} is a word, and has no least or most", where, excerpt(name)));
}

}  // namespace parallax
