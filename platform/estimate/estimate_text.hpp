// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "platform/config/machine_config.hpp"
#include "platform/estimate/device_fit.hpp"

namespace parallax {

/// An estimate as a table: stages, their memories, FIFOs, DMA engines, and the sum. What was not calibrated
/// has a mark.
std::string estimate_as_text(const ResourceEstimate& estimate, const DeviceFile& device);

/// The device's cells, what is taken of each, and the verdict: "fits zynq-7045", or by how much it does not.
std::string device_as_text(const ResourceEstimate& estimate, const DeviceFile& device);

/// One line of a list of devices.
std::string device_as_line(const ResourceEstimate& estimate, const DeviceFile& device);

/// For each FIFO that is LUT RAM only because it is read in the same cycle, and would be much less as block
/// RAM: the key that makes it so, and what that takes.
std::string deep_fifos_as_text(const ResourceEstimate& estimate, const DeviceFile& device);

}  // namespace parallax
