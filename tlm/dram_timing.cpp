// SPDX-License-Identifier: Apache-2.0
#include "tlm/dram_timing.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tlm/error.hpp"

namespace parallax {

void DramTiming::validate() const {
  const auto require = [](bool holds, const std::string& line) {
    if (!holds) throw UserError(line);
  };
  const auto positive = [&](const char* name, std::int64_t value) {
    require(value >= 1, fmt::format("dram.{} = {}: must be at least 1", name, value));
  };
  positive("clock_period_ps", clock_period_ps);
  positive("burst_length", burst_length);
  positive("bus_bytes", bus_bytes);
  positive("banks", banks);
  positive("bank_groups", bank_groups);
  positive("rows", rows);
  positive("columns", columns);
  require(burst_length % 2 == 0,
          fmt::format("dram.burst_length = {}: must be even, data moves twice a clock", burst_length));
  require(
      columns % burst_length == 0,
      fmt::format("dram.columns = {}: must be a multiple of dram.burst_length = {}", columns, burst_length));
  require(banks % bank_groups == 0,
          fmt::format("dram.bank_groups = {}: must divide dram.banks = {}", bank_groups, banks));
  require(ccd >= burst_clocks(),
          fmt::format("dram.ccd = {}: must be at least {}, half of dram.burst_length", ccd, burst_clocks()));
  // A refresh closes all rows; between two of them one must be opened and read, or nothing ever is. What may
  // come before the row opens, from when the refresh is due: its rows stay open, are closed, it takes its
  // time, and opened may be only what has not been just before. Each bank may take the bus for a command
  // meanwhile.
  const std::int64_t open = std::max({ras, rtp, cwl + burst_clocks() + wr});
  const std::int64_t closed = std::max({rc, open + std::max(rp, rp_all)});
  const std::int64_t least = std::max({closed + rfc, rrd, rrd_group, faw}) + rcd + banks;
  require(
      refi == 0 || refi > least,
      fmt::format(
          "dram.refi = {}: must be 0 or more than {}, the clocks in which a row is closed, refreshed, opened "
          "and read "
          "(dram.ras, dram.rp, dram.rfc, dram.rcd and others), or no row is ever read between two refreshes",
          refi, least));
}

}  // namespace parallax
