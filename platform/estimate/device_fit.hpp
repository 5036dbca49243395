// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "platform/estimate/estimate.hpp"

namespace parallax {

/// What a design takes of one kind of cell that a device has.
struct DeviceShare {
  std::string resource;  ///< "lut", "lut_memory", "ff", "block_ram", "dsp": as the metrics are called
  std::string name;      ///< "LUT", "FF", "RAMB18": for readers
  std::int64_t taken = 0;
  std::int64_t available = 0;

  bool fits() const { return taken <= available; }
  double percent() const;
};

/// The shares of all kinds of cells whose number is known.
std::vector<DeviceShare> device_shares(const Resources& total, const DeviceFile& device);

/// Whether all of them fit.
bool fits(const std::vector<DeviceShare>& shares);

}  // namespace parallax
