// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace parallax {

/// A rank of DRAM devices side by side, in JEDEC's terms. Times in clocks of the command bus unless stated.
/// Defaults: DDR3-1066 7-7-7, two x16 4 Gb devices (JESD79-3F).
struct DramTiming {
  std::int64_t clock_period_ps = 1875;  ///< tCK; data moves twice a clock
  std::int64_t cl = 7;                  ///< read command to first data
  std::int64_t cwl = 6;                 ///< write command to first data
  std::int64_t rcd = 7;                 ///< activate to read or write
  std::int64_t rp = 7;                  ///< precharge to activate
  std::int64_t rp_all = 7;              ///< precharge of all banks to refresh (tRPab)
  std::int64_t ras = 20;                ///< activate to precharge
  std::int64_t rc = 27;                 ///< activate to activate, same bank
  std::int64_t rrd = 6;                 ///< activate to activate, other bank (tRRD_S)
  std::int64_t rrd_group = 6;           ///< likewise in the same bank group (tRRD_L)
  std::int64_t faw = 27;                ///< window that holds at most four activates
  std::int64_t wr = 8;                  ///< last write data to precharge
  std::int64_t wtr = 4;                 ///< last write data to read (tWTR_S)
  std::int64_t wtr_group = 4;           ///< likewise in the same bank group (tWTR_L)
  std::int64_t rtp = 4;                 ///< read to precharge
  std::int64_t ccd = 4;                 ///< column command to column command (tCCD_S)
  std::int64_t ccd_group = 4;           ///< likewise in the same bank group (tCCD_L)
  std::int64_t rtw = 7;                 ///< read command to write command
  std::int64_t rfc = 139;               ///< refresh to activate
  std::int64_t refi = 4160;             ///< between refreshes of all banks; 0: none

  std::int64_t burst_length = 8;  ///< beats
  std::int64_t bus_bytes = 4;     ///< width of the data bus
  std::int64_t banks = 8;         ///< of all groups
  std::int64_t bank_groups = 1;   ///< a bank's group is its number modulo this
  std::int64_t rows = 32768;      ///< a bank
  std::int64_t columns = 1024;    ///< a row, in words of the bus

  /// Throws UserError when values are impossible, alone or together; it names them as configuration keys,
  /// dram.*.
  void validate() const;

  std::int64_t burst_clocks() const { return burst_length / 2; }
  std::int64_t burst_bytes() const { return burst_length * bus_bytes; }
  std::int64_t row_bytes() const { return columns * bus_bytes; }
  std::int64_t bytes() const { return row_bytes() * rows * banks; }
  /// Bytes per second on the data bus without a pause.
  double peak_bandwidth() const {
    return 2.0 * static_cast<double>(bus_bytes) * 1e12 / static_cast<double>(clock_period_ps);
  }
};

}  // namespace parallax
