// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace parallax {

class Schema;

/// What a unit of activity costs, for the energy estimate (results/energy.hpp). It changes no date and no
/// value. Nothing here is fitted to the device's published power; where a number comes from is in
/// energy_config.cpp.
struct EnergyConfig {
  double census_bit_pj = 0.1;   ///< pJ per census bit compared and counted, 0 to 10^6; I
  double path_update_pj = 3.4;  ///< pJ per cost updated, one pixel, disparity and path, 0 to 10^6; I
  double stage_bit_pj = 0.2;    ///< pJ per bit that a stage other than the matcher reads, 0 to 10^6; I
  double core_cycle_pj = 1000;  ///< pJ per cycle of clocks.core_hz, in the clock network, 0 to 10^9; I

  double on_chip_byte_pj = 2.5;  ///< pJ per byte written to or read from on-chip memory, 0 to 10^6; I

  double dram_bit_pj = 20;               ///< pJ per bit moved, 0 to 10^6; I
  double dram_activate_nj = 5;           ///< nJ per row opened and closed, 0 to 10^6; I
  std::uint32_t dram_access_bytes = 32;  ///< bytes of one access, 1 to 4096; D
  double dram_row_hits = 75;             ///< percent of the accesses that find their row open, 0 to 100; I
  double dram_background_w = 0.15;       ///< W with no access under way, refresh included, 0 to 1000; I

  double link_bit_pj = 20;          ///< pJ per bit on the wire, 0 to 10^6; I
  double link_w = 0.6;              ///< W of the transceiver, at work or not, 0 to 1000; I
  double camera_byte_pj = 100;      ///< pJ per byte from the cameras, 0 to 10^6; I
  double camera_interface_w = 1.0;  ///< W of the interface to both cameras, at work or not, 0 to 1000; I

  double static_w = 0.3;          ///< W of leakage in the FPGA, 0 to 1000; I
  double processor_w = 1.5;       ///< W of the processor that runs the software, 0 to 1000; I
  double supply_efficiency = 85;  ///< percent of the device's power that its converters pass on, 1 to 100; I
};

void describe(Schema& schema, EnergyConfig& config);

}  // namespace parallax
