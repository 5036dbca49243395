// SPDX-License-Identifier: Apache-2.0
#include "tlm/dram_timing.hpp"

#include <fmt/format.h>

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
  // Or no row could be opened and read between two refreshes.
  require(refi == 0 || refi > rfc + rp_all + rc,
          fmt::format("dram.refi = {}: must be 0 or more than dram.rfc + dram.rp_all + dram.rc = {}", refi,
                      rfc + rp_all + rc));
}

}  // namespace parallax
