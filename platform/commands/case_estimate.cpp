// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/case_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "platform/config/preset.hpp"
#include "platform/estimate/estimate.hpp"
#include "platform/estimate/estimate_metrics.hpp"
#include "platform/results/file_content.hpp"
#include "platform/results/glossary.hpp"

namespace parallax {
namespace {

constexpr const char* kUsualFamily = "7-series";

std::optional<DeviceFile> device_of(const std::string& device, const std::vector<std::string>& metrics) {
  if (!device.empty()) return load_device(device, preset_folders());
  const bool asked = std::any_of(metrics.begin(), metrics.end(), [](const std::string& name) {
    return find_estimate_metric(name) != nullptr;
  });
  return asked ? std::optional(load_family(kUsualFamily, preset_folders())) : std::nullopt;
}

// All that a device's file and those that it inherits from say.
std::string device_text(std::optional<DeviceFile> device) {
  if (!device) return "";
  Schema schema;
  describe(schema, *device);
  FileContent content;
  for (const EffectiveKey& key : effective_keys(schema)) {
    const std::string line = fmt::format("{}.{}={}\n", key.section, key.name, to_toml(key.value));
    content.add(line.data(), line.size());
  }
  return fmt::format(" on {} {:08x}", device->name, content.crc);
}

}  // namespace

CaseEstimate::CaseEstimate(const std::string& device, const std::vector<std::string>& metrics)
    : shares_(!device.empty()), device_(device_of(device, metrics)), identity_(device_text(device_)) {}

void CaseEstimate::add_to(EvaluationCase& one) const {
  if (!device_) return;
  const ResourceEstimate resources =
      estimate(one.configuration.machine, *device_, {one.input.width, one.input.height});
  add_resources(one.further, resources, *device_);
  if (shares_) add_device(one.further, resources, *device_);
}

}  // namespace parallax
