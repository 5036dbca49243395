// SPDX-License-Identifier: Apache-2.0
#include "platform/estimate/device_fit.hpp"

#include <algorithm>

namespace parallax {

double DeviceShare::percent() const {
  return 100.0 * static_cast<double>(taken) / static_cast<double>(available);
}

std::vector<DeviceShare> device_shares(const Resources& total, const DeviceFile& device) {
  const DeviceTotals& has = device.totals;
  std::vector<DeviceShare> shares;
  const auto add = [&](const char* resource, const std::string& name, std::int64_t taken,
                       std::int64_t available) {
    if (available > 0) shares.push_back({resource, name, taken, available});
  };
  add("lut", "LUT", total.luts(), has.luts);
  add("lut_memory", "LUT as memory", total.memory_luts(), has.memory_luts);
  add("ff", "FF", total.registers, has.registers);
  add("block_ram", device.block_ram_unit, total.block_rams, has.block_rams);
  add("dsp", "DSP", total.dsps, has.dsps);
  return shares;
}

bool fits(const std::vector<DeviceShare>& shares) {
  return std::all_of(shares.begin(), shares.end(), [](const DeviceShare& share) { return share.fits(); });
}

}  // namespace parallax
