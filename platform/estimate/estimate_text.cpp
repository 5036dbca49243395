// SPDX-License-Identifier: Apache-2.0
#include "platform/estimate/estimate_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "platform/estimate/fifo_circuit.hpp"

namespace parallax {
namespace {

constexpr const char* kTitles[] = {"stages", "memories of stages", "FIFOs", "DMA engines"};
constexpr const char* kUncalibrated = "*";
constexpr std::int64_t kWorthSaying = 300;  // LUTs that another kind of FIFO saves

std::string line(const std::string& name, const Resources& cells, const std::string& behind) {
  return fmt::format("{:<30} {:>8} {:>8} {:>8} {:>8} {:>8} {:>5}{}{}\n", name, cells.luts(), cells.ram_luts,
                     cells.shift_luts, cells.registers, cells.block_rams, cells.dsps,
                     behind.empty() ? "" : "  ", behind);
}

std::string short_by(const DeviceShare& share) {
  return fmt::format("{} {} of {}, {} too many", share.taken, share.name, share.available,
                     share.taken - share.available);
}

std::string lacks(const std::vector<DeviceShare>& shares) {
  std::string text;
  for (const DeviceShare& share : shares) {
    if (!share.fits()) text += (text.empty() ? "" : "; ") + short_by(share);
  }
  return text;
}

}  // namespace

std::string estimate_as_text(const ResourceEstimate& estimate, const DeviceFile& device) {
  std::string text = fmt::format("{:<30} {:>8} {:>8} {:>8} {:>8} {:>8} {:>5}\n", device.family, "LUT",
                                 "LUT RAM", "SRL", "FF", device.block_ram_unit, "DSP");
  const PartEstimate* before = nullptr;
  for (const PartEstimate& part : estimate.parts) {
    if (before == nullptr || before->kind != part.kind)
      text += fmt::format("{}\n", kTitles[static_cast<std::size_t>(part.kind)]);
    text += line("  " + part.name + (part.calibrated ? "" : kUncalibrated), part.resources, part.shape);
    before = &part;
  }
  text += line("total", estimate.total, "");
  return text + fmt::format("{} not calibrated: from declared widths and counts\n", kUncalibrated);
}

std::string device_as_text(const ResourceEstimate& estimate, const DeviceFile& device) {
  const std::vector<DeviceShare> shares = device_shares(estimate.total, device);
  std::string text = fmt::format("{}\n", device.name);
  for (const DeviceShare& share : shares) {
    text += fmt::format("  {:<14} {:>8} of {:>8} {:>8.1f} %\n", share.name, share.taken, share.available,
                        share.percent());
  }
  const std::string missing = lacks(shares);
  return text + (missing.empty() ? fmt::format("fits {}\n", device.name)
                                 : fmt::format("does not fit {}: {}\n", device.name, missing));
}

std::string device_as_line(const ResourceEstimate& estimate, const DeviceFile& device) {
  const std::vector<DeviceShare> shares = device_shares(estimate.total, device);
  const auto fullest =
      std::max_element(shares.begin(), shares.end(),
                       [](const DeviceShare& a, const DeviceShare& b) { return a.percent() < b.percent(); });
  const std::string missing = lacks(shares);
  if (!missing.empty()) return fmt::format("  {:<14} no: {}\n", device.name, missing);
  return fmt::format("  {:<14} yes: {:.1f} % of {}\n", device.name, fullest->percent(), fullest->name);
}

std::string deep_fifos_as_text(const ResourceEstimate& estimate, const DeviceFile& device) {
  std::string text;
  for (const PartEstimate& part : estimate.parts) {
    if (part.kind != PartEstimate::Kind::kFifo || part.resources.ram_luts < kWorthSaying) continue;
    FifoCircuit other = part.fifo;
    other.kind = FifoKind::kBlockRam;
    const Resources made = fifo_circuit(other, device).all();
    if (made.block_rams == 0 || part.resources.luts() - made.luts() < kWorthSaying) continue;
    text += fmt::format("streams.{}.kind = block_ram: {} {} and {} LUT in place of {} LUT\n", part.name,
                        made.block_rams, device.block_ram_unit, made.luts(), part.resources.luts());
  }
  return text;
}

}  // namespace parallax
