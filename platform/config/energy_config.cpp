// SPDX-License-Identifier: Apache-2.0
#include "platform/config/energy_config.hpp"

#include <string>
#include <utility>

#include "platform/config/schema.hpp"

namespace parallax {
namespace {

constexpr double kLargestWatts = 1000;

void describe_core(Schema& schema, EnergyConfig& config) {
  const auto picojoules = [&](std::string path, double& field, std::string documentation,
                              std::string source) {
    schema.real(std::move(path), field, {0, 1e6}, "pJ", std::move(documentation),
                inferred(std::move(source)));
  };
  picojoules("energy.census_bit_pj", config.census_bit_pj,
             "Energy to compare one bit of two census codes and to count it.",
             "two cells of an adder: an 8-bit addition takes 0.03 pJ at 45 nm (Horowitz, ISSCC 2014), and an "
             "FPGA 14 times an ASIC's (Kuon and Rose, IEEE TCAD 2007)");
  picojoules("energy.path_update_pj", config.path_update_pj,
             "Energy to update one path cost: one pixel, disparity and path.",
             "eight 8-bit additions and comparisons at 0.03 pJ (Horowitz, ISSCC 2014), and an FPGA 14 times "
             "an ASIC's (Kuon and Rose, IEEE TCAD 2007)");
  picojoules("energy.stage_bit_pj", config.stage_bit_pj,
             "Energy that a stage other than the matcher spends on each bit that it reads.",
             "four 8-bit operations on each eight bits, at the energies of energy.path_update_pj");
  schema.real(
      "energy.core_cycle_pj", config.core_cycle_pj, {0, 1e9}, "pJ",
      "Energy of the core's clock network and its registers in each cycle, at work or not.",
      inferred(
          "some 50,000 registers at 20 fJ; 0.1 to 0.3 W are usual for such a clock at 200 MHz in 28 nm"));
  picojoules("energy.on_chip_byte_pj", config.on_chip_byte_pj,
             "Energy to write a byte to, or read one from, a line buffer or a FIFO.",
             "10 pJ for 8 bytes of an 8-KB memory at 45 nm (Horowitz, ISSCC 2014), twice that for an FPGA's "
             "routing");
}

void describe_memory(Schema& schema, EnergyConfig& config) {
  schema.real("energy.dram_bit_pj", config.dram_bit_pj, {0, 1e6}, "pJ",
              "Energy of the DRAM for each bit moved: array, interface and termination; the controller's "
              "part is in energy.processor_w.",
              inferred("about 10 pJ by (IDD4 - IDD3N) * VDD of usual DDR3-1066 devices, and as much for "
                       "interface and termination (method of Micron TN-41-01)"));
  schema.real("energy.dram_activate_nj", config.dram_activate_nj, {0, 1e6}, "nJ",
              "Energy to open and close one row, in all devices together.",
              inferred("two devices, each some 33 mA above standby at 1.5 V during tRC = 50 ns (IDD0 of "
                       "usual DDR3-1066 devices, method of Micron TN-41-01)"));
  schema.integer("energy.dram_access_bytes", config.dram_access_bytes, {1, 4096}, "B",
                 "Bytes of one access to the memory when it is modelled as a bus; energy.dram_row_hits of "
                 "these find their row "
                 "open. A DRAM counts the rows that it opens itself.",
                 derived("a burst of eight transfers of 32 bits"));
  schema.real("energy.dram_row_hits", config.dram_row_hits, {0, 100}, "%",
              "Share of the accesses that find their row open; the others open one.",
              inferred("every DMA burst of 128 B opens a row for its four accesses"));
  schema.real(
      "energy.dram_background_w", config.dram_background_w, {0, kLargestWatts}, "W",
      "Power of the DRAM with no access under way, refresh included.",
      inferred("two devices with an IDD3N of some 45 mA at 1.5 V, and refresh (method of Micron TN-41-01)"));
}

void describe_periphery(Schema& schema, EnergyConfig& config) {
  const auto picojoules = [&](std::string path, double& field, std::string documentation,
                              std::string source) {
    schema.real(std::move(path), field, {0, 1e6}, "pJ", std::move(documentation),
                inferred(std::move(source)));
  };
  const auto watts = [&](std::string path, double& field, std::string documentation, std::string source) {
    schema.real(std::move(path), field, {0, kLargestWatts}, "W", std::move(documentation),
                inferred(std::move(source)));
  };
  picojoules("energy.link_bit_pj", config.link_bit_pj,
             "Energy of the media access controller for each bit on the wire.",
             "logic and buffers beside a transceiver that sends idle symbols at the same power");
  watts("energy.link_w", config.link_w,
        "Power of the Ethernet transceiver, at work or not; none when link.enabled is off.",
        "usual for a gigabit transceiver: 0.4 to 1 W");
  picojoules("energy.camera_byte_pj", config.camera_byte_pj,
             "Energy of the cameras' interface for each byte that it receives.",
             "usual for a serial receiver: about 10 pJ a bit");
  watts("energy.camera_interface_w", config.camera_interface_w,
        "Power of the interface to both cameras, at work or not, without the cameras.",
        "usual for a host controller with two USB 3.0 ports: 0.5 to 1.5 W");
  watts("energy.static_w", config.static_w, "Power of the FPGA's leakage.",
        "usual for a warm 28-nm device of the Zynq-7000 class: 0.2 to 0.5 W");
  watts("energy.processor_w", config.processor_w,
        "Power of the processor that runs the device's software, with its DRAM controller.",
        "usual in power estimates of a Zynq-7000's two cores at 667 MHz with DDR3-1066: about 1.5 W");
  schema.real("energy.supply_efficiency", config.supply_efficiency, {1, 100}, "%",
              "Share of the power drawn that the voltage converters pass on to all other parts.",
              inferred("usual for switching converters: 80 to 90 %"));
}

}  // namespace

void describe(Schema& schema, EnergyConfig& config) {
  describe_core(schema, config);
  describe_memory(schema, config);
  describe_periphery(schema, config);
}

}  // namespace parallax
