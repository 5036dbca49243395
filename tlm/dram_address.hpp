// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tlm/dram_timing.hpp"

namespace parallax {

/// Where the bits of an address go, from high to low; the byte in a bus word is below.
enum class DramMapping {
  kRowBankColumn,       ///< "rbc": a stream passes through all banks, row by row
  kBankRowColumn,       ///< "brc": each bank is one piece of the address space
  kRowBankColumnGroup,  ///< "rbcg": as rbc, but bursts go to the bank groups in turn
};

struct DramPlace {
  std::uint32_t bank = 0;
  std::uint32_t row = 0;
};

/// Takes an address apart. Addresses beyond the memory's size wrap around.
class DramAddress {
 public:
  DramAddress(const DramTiming& timing, DramMapping mapping);

  DramPlace place(std::uint64_t address) const {
    const std::uint64_t above = address / row_bytes_;
    switch (mapping_) {
      case DramMapping::kRowBankColumn:
        return at(above % banks_, above / banks_);
      case DramMapping::kBankRowColumn:
        return at(above / rows_, above);
      case DramMapping::kRowBankColumnGroup: {
        // A row of each group lies side by side, burst by burst.
        const std::uint64_t rows = above / groups_;
        const std::uint64_t in_group = banks_ / groups_;
        return at(rows % in_group * groups_ + address / burst_bytes_ % groups_, rows / in_group);
      }
    }
    return {};
  }

 private:
  DramPlace at(std::uint64_t bank, std::uint64_t row) const {
    return {static_cast<std::uint32_t>(bank % banks_), static_cast<std::uint32_t>(row % rows_)};
  }

  std::uint64_t row_bytes_;
  std::uint64_t burst_bytes_;
  std::uint64_t groups_;
  std::uint64_t banks_;
  std::uint64_t rows_;
  DramMapping mapping_;
};

}  // namespace parallax
