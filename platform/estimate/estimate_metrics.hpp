// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "platform/estimate/device_fit.hpp"
#include "traces/metric_table.hpp"

namespace parallax {

/// A device's name, or file, as a name in a tree: "zynq_7020".
std::string device_group(const std::string& device);

/// The numbers of an estimate.
const MetricTable& estimate_table();

/// The tree: resources/lut and so on of all, and of each part.
void add_resources(MetricGroup& root, const ResourceEstimate& estimate, const DeviceFile& device);

/// What a device has to say of it: devices/<device>/fits, and the shares.
void add_device(MetricGroup& root, const ResourceEstimate& estimate, const DeviceFile& device);

}  // namespace parallax
