// SPDX-License-Identifier: Apache-2.0
#include "platform/config/dram_device.hpp"

#include <fmt/format.h>

#include "platform/config/preset.hpp"
#include "platform/config/schema.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr IntegerRange kClocks{0, 100'000};
constexpr const char* kDefaultDevice = "JESD79-3F: DDR3-1066 7-7-7, two x16 devices of 4 Gb";

/// A time that is inherited as a number of clocks is another one in ns where a clock is longer or shorter:
/// who states the clock's period states them all.
void require_times_with_the_clock(const RawConfig& values, const Schema& schema) {
  const auto period = values.find("dram.clock_period_ps");
  if (period == values.end()) return;
  std::string inherited;
  for (const Key& key : schema.keys()) {
    if (key.unit != "clocks") continue;
    const auto found = values.find(key.path);
    if (found != values.end() && found->second.layer >= period->second.layer) continue;
    inherited += (inherited.empty() ? "" : ", ") + key.path;
  }
  if (inherited.empty()) return;
  throw UserError(
      fmt::format("{}: dram.clock_period_ps is stated without all times in its clocks; state too: {}",
                  period->second.origin, inherited));
}

}  // namespace

void describe(Schema& schema, DramTiming& timing) {
  const Provenance origin = stated(kDefaultDevice);
  const auto clocks = [&](const char* name, std::int64_t& field, const char* documentation) {
    schema.integer(std::string("dram.") + name, field, kClocks, "clocks", documentation, origin);
  };
  schema.integer("dram.clock_period_ps", timing.clock_period_ps, {100, 100'000}, "ps",
                 "Period of the command clock (tCK); data moves twice in it.", origin);
  clocks("cl", timing.cl, "Read command to first data (CL, RL).");
  clocks("cwl", timing.cwl, "Write command to first data (CWL, WL).");
  clocks("rcd", timing.rcd, "Activate to read or write (tRCD).");
  clocks("rp", timing.rp, "Precharge of a bank to activate (tRP).");
  clocks("rp_all", timing.rp_all, "Precharge of all banks to refresh (tRPab).");
  clocks("ras", timing.ras, "Activate to precharge (tRAS).");
  clocks("rc", timing.rc, "Activate to activate in one bank (tRC).");
  clocks("rrd", timing.rrd, "Activate to activate in another bank (tRRD, tRRD_S).");
  clocks("rrd_group", timing.rrd_group, "The same within a bank group (tRRD_L).");
  clocks("faw", timing.faw, "Window that holds at most four activates (tFAW).");
  clocks("wr", timing.wr, "Last write data to precharge (tWR).");
  clocks("wtr", timing.wtr, "Last write data to read (tWTR, tWTR_S).");
  clocks("wtr_group", timing.wtr_group, "The same within a bank group (tWTR_L).");
  clocks("rtp", timing.rtp, "Read to precharge (tRTP).");
  clocks("ccd", timing.ccd, "Read to read, and write to write (tCCD, tCCD_S); at least burst_length / 2.");
  clocks("ccd_group", timing.ccd_group, "The same within a bank group (tCCD_L).");
  clocks("rtw", timing.rtw, "Read command to write command.");
  clocks("rfc", timing.rfc, "Refresh of all banks to activate (tRFC).");
  schema.integer("dram.refi", timing.refi, {0, 1'000'000'000}, "clocks",
                 "Between two refreshes of all banks (tREFI); 0: none.", origin);
  schema.integer("dram.burst_length", timing.burst_length, {2, 64}, "beats", "Beats of a burst, even.",
                 origin);
  schema.integer("dram.bus_bytes", timing.bus_bytes, {1, 128}, "B", "Width of the data bus.", origin);
  schema.integer("dram.banks", timing.banks, {1, 256}, "banks", "Banks of all groups.", origin);
  schema.integer("dram.bank_groups", timing.bank_groups, {1, 64}, "groups",
                 "Bank groups, a divisor of dram.banks; a bank's group is its number modulo this.", origin);
  schema.integer("dram.rows", timing.rows, {1, 1 << 24}, "rows", "Rows of a bank.", origin);
  schema.integer("dram.columns", timing.columns, {8, 1 << 16}, "words",
                 "Columns of a row, in words of the bus; a multiple of dram.burst_length.", origin);
}

RawConfig read_dram_device(const std::string& name,
                           const std::vector<std::filesystem::path>& preset_folders) {
  std::vector<std::filesystem::path> folders;
  for (const std::filesystem::path& folder : preset_folders) folders.push_back(folder / "memory");
  RawConfig values = load_preset(name, folders, "memory device");
  DramTiming timing;  // so that nothing but a device's keys gets through
  Schema schema;
  describe(schema, timing);
  schema.apply(values);
  require_times_with_the_clock(values, schema);
  timing.validate();
  return values;
}

DramTiming load_dram_device(const std::string& name,
                            const std::vector<std::filesystem::path>& preset_folders) {
  DramTiming timing;
  Schema schema;
  describe(schema, timing);
  schema.apply(read_dram_device(name, preset_folders));
  return timing;
}

}  // namespace parallax
