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

struct DramLocation {
  std::uint32_t bank = 0;
  std::uint32_t row = 0;
};

/// Takes an address apart. Addresses beyond the memory's size wrap around.
class DramAddress {
 public:
  DramAddress(const DramTiming& timing, DramMapping mapping);

  DramLocation locate(std::uint64_t address) const {
    const std::uint64_t above = row_bytes_.quotient(address);
    switch (mapping_) {
      case DramMapping::kRowBankColumn:
        return at(banks_.remainder(above), banks_.quotient(above));
      case DramMapping::kBankRowColumn:
        return at(rows_.quotient(above), above);
      case DramMapping::kRowBankColumnGroup: {
        // A row of each group lies side by side, burst by burst.
        const std::uint64_t rows = groups_.quotient(above);
        const std::uint64_t group = groups_.remainder(burst_bytes_.quotient(address));
        return at(group_banks_.remainder(rows) * groups_.value() + group, group_banks_.quotient(rows));
      }
    }
    return {};
  }
  /// How many bursts from the one at `address` on lie one after the other in its row.
  std::uint64_t bursts_in_row(std::uint64_t address) const {
    if (mapping_ == DramMapping::kRowBankColumnGroup) return 1;
    return burst_bytes_.quotient(row_bytes_.value() - row_bytes_.remainder(address) + burst_bytes_.value() -
                                 1);
  }

 private:
  // Divides by what is a power of two in nearly all devices.
  class Divisor {
   public:
    explicit Divisor(std::int64_t value)
        : value_(static_cast<std::uint64_t>(value)),
          shift_((value_ & (value_ - 1)) == 0 ? __builtin_ctzll(value_) : -1) {}
    std::uint64_t value() const { return value_; }
    std::uint64_t quotient(std::uint64_t x) const { return shift_ < 0 ? x / value_ : x >> shift_; }
    std::uint64_t remainder(std::uint64_t x) const { return shift_ < 0 ? x % value_ : x & (value_ - 1); }

   private:
    std::uint64_t value_;
    int shift_;
  };

  DramLocation at(std::uint64_t bank, std::uint64_t row) const {
    return {static_cast<std::uint32_t>(banks_.remainder(bank)),
            static_cast<std::uint32_t>(rows_.remainder(row))};
  }

  Divisor row_bytes_;
  Divisor burst_bytes_;
  Divisor groups_;
  Divisor banks_;
  Divisor group_banks_;
  Divisor rows_;
  DramMapping mapping_;
};

}  // namespace parallax
