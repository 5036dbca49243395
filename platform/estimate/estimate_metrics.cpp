// SPDX-License-Identifier: Apache-2.0
#include "platform/estimate/estimate_metrics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace parallax {
namespace {

constexpr const char* kPartPaths[] = {"resources/stage/<stage>", "resources/buffer/<buffer>",
                                      "resources/fifo/<stream>", "resources/engine/<port>"};

void add_cells(const MetricWriter& out, const std::string& path, const Resources& cells) {
  out.add(path + "/lut", cells.luts());
  out.add(path + "/lut_ram", cells.ram_luts);
  out.add(path + "/srl", cells.shift_luts);
  out.add(path + "/ff", cells.registers);
  out.add(path + "/block_ram", cells.block_rams);
  out.add(path + "/dsp", cells.dsps);
}

std::vector<MetricInfo> rows_of(const std::string& path, const std::string& whose) {
  return {
      {path + "/lut", "LUTs", "LUTs of " + whose + ", those that are RAM or shift registers among them.", ""},
      {path + "/lut_ram", "LUTs", "LUTs of " + whose + " that are RAM.", ""},
      {path + "/srl", "LUTs", "LUTs of " + whose + " that are shift registers.", ""},
      {path + "/ff", "FFs", "Flip-flops of " + whose + ".", ""},
      {path + "/block_ram", "blocks", "Block RAMs of " + whose + ", in the unit of resources/block_ram_unit.",
       ""},
      {path + "/dsp", "DSPs", "DSP blocks of " + whose + ".", ""},
  };
}

}  // namespace

std::string device_group(const std::string& device) {
  std::string name;
  for (const char c : std::filesystem::path(device).stem().string()) {
    const auto letter = static_cast<unsigned char>(c);
    name += std::isalnum(letter) != 0 ? static_cast<char>(std::tolower(letter)) : '_';
  }
  return name;
}

const MetricTable& estimate_table() {
  static const MetricTable table = [] {
    MetricTable rows{
        {"resources/family", "", "FPGA family whose cells these are.", ""},
        {"resources/block_ram_unit", "",
         "The block RAM that is counted: the family's smallest. In the 7 series a RAMB36 counts as two "
         "RAMB18.",
         ""},
        {"resources/calibrated", "%",
         "Share of the LUTs in parts whose circuit was held against what a synthesiser makes of it.", ""},
        {"devices/<device>/fits", "", "Whether no kind of cell is taken beyond what the device has.", ""},
        {"devices/<device>/lut", "%", "Share of the device's LUTs.", ""},
        {"devices/<device>/lut_memory", "%", "Share of the device's LUTs that can be RAM or shift registers.",
         ""},
        {"devices/<device>/ff", "%", "Share of the device's flip-flops.", ""},
        {"devices/<device>/block_ram", "%", "Share of the device's block RAMs.", ""},
        {"devices/<device>/dsp", "%", "Share of the device's DSP blocks.", ""},
    };
    rows.append(rows_of("resources", "the machine"));
    rows.append(rows_of(kPartPaths[0], "the stage without its memories"));
    rows.append(rows_of(kPartPaths[1], "a memory of a stage"));
    rows.append(rows_of(kPartPaths[2], "the FIFO"));
    rows.append(rows_of(kPartPaths[3], "the DMA engine at the port"));
    return rows;
  }();
  return table;
}

void add_resources(MetricGroup& root, const ResourceEstimate& estimate, const DeviceFile& device) {
  const MetricWriter out(root, estimate_table());
  out.add("resources/family", device.family);
  out.add("resources/block_ram_unit", device.block_ram_unit);
  add_cells(out, "resources", estimate.total);
  std::int64_t calibrated = 0;
  for (const PartEstimate& part : estimate.parts) {
    if (part.calibrated) calibrated += part.resources.luts();
    add_cells(out.of(part.name), kPartPaths[static_cast<std::size_t>(part.kind)], part.resources);
  }
  const double all = static_cast<double>(std::max<std::int64_t>(1, estimate.total.luts()));
  out.add("resources/calibrated", 100.0 * static_cast<double>(calibrated) / all);
}

void add_device(MetricGroup& root, const ResourceEstimate& estimate, const DeviceFile& device) {
  const MetricWriter out = MetricWriter(root, estimate_table()).of(device_group(device.name));
  const std::vector<DeviceShare> shares = device_shares(estimate.total, device);
  out.add("devices/<device>/fits", fits(shares));
  for (const DeviceShare& share : shares)
    out.add(fmt::format("devices/<device>/{}", share.resource), share.percent());
}

}  // namespace parallax
