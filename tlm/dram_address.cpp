// SPDX-License-Identifier: Apache-2.0
#include "tlm/dram_address.hpp"

namespace parallax {

DramAddress::DramAddress(const DramTiming& timing, DramMapping mapping)
    : row_bytes_(static_cast<std::uint64_t>(timing.row_bytes())),
      burst_bytes_(static_cast<std::uint64_t>(timing.burst_bytes())),
      groups_(static_cast<std::uint64_t>(timing.bank_groups)),
      banks_(static_cast<std::uint64_t>(timing.banks)),
      rows_(static_cast<std::uint64_t>(timing.rows)),
      mapping_(mapping) {}

}  // namespace parallax
