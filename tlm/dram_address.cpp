// SPDX-License-Identifier: Apache-2.0
#include "tlm/dram_address.hpp"

namespace parallax {

DramAddress::DramAddress(const DramTiming& timing, DramMapping mapping)
    : row_bytes_(timing.row_bytes()),
      burst_bytes_(timing.burst_bytes()),
      groups_(timing.bank_groups),
      banks_(timing.banks),
      group_banks_(timing.banks / timing.bank_groups),
      rows_(timing.rows),
      mapping_(mapping) {}

}  // namespace parallax
