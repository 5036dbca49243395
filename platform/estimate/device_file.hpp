// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "platform/estimate/circuit_costs.hpp"

namespace parallax {

class Schema;

/// What a RAM primitive can be.
struct RamShape {
  std::int64_t words = 0;
  std::int64_t bits = 0;
};

/// A kind of RAM primitive: its shapes, what it takes of the device, and the weights by which a synthesiser
/// chooses among kinds.
struct RamKind {
  std::string shapes_text;  ///< "2048x9, 1024x18"; "none"
  std::vector<RamShape> shapes;
  std::int64_t units = 1;   ///< blocks, or LUTs, that one primitive takes
  double weight = 0;        ///< of a primitive, whatever is used of its width
  double width_weight = 0;  ///< of a primitive whose whole width is used; a part of it, of a part
};

/// What is in a device. 0: not known, and not judged.
struct DeviceTotals {
  std::int64_t luts = 0;
  std::int64_t memory_luts = 0;  ///< of these, that can be memory or shift registers
  std::int64_t registers = 0;
  std::int64_t block_rams = 0;  ///< in the family's unit
  std::int64_t dsps = 0;
};

/// A device and how memories and arithmetic map in its family.
struct DeviceFile {
  std::string name;  ///< as it was asked for
  DeviceTotals totals;

  std::string family = "7 series";
  std::string block_ram_unit = "RAMB18";
  bool calibrated =
      true;           ///< whether the costs were fitted to circuits that were synthesised for this family
  RamKind block_ram;  ///< the family's unit
  RamKind double_block_ram;                ///< two of them together
  RamKind lut_ram;                         ///< read in the same cycle
  double register_weight = 1;              ///< of a bit in a register, beside the weights of RAM kinds
  double multiplexer_weight = 0.5;         ///< of a bit of a choice of two behind banks
  double bank_weight = 8;                  ///< of the decoding of a bank of RAM
  std::int64_t shift_register_words = 32;  ///< that a LUT holds of one bit; 0: LUTs are none
  std::int64_t multiplier_a_bits = 24;     ///< unsigned operands of one DSP
  std::int64_t multiplier_b_bits = 17;
  std::int64_t multiplier_least_bits = 1;  ///< a rest of an operand with fewer bits goes into LUTs
  std::int64_t collision_registers = 0;    ///< a bit of a block RAM that may be written where it is read
  CircuitCosts costs;
};

/// A device file's keys.
void describe(Schema& schema, DeviceFile& device);

/// A device by name, from `devices/<name>.toml` in the preset folders, or by path. Throws UserError, one
/// line: not found (with the nearest name), unreadable, an unknown key, a missing one, a value out of range,
/// a shape that is none, no total at all.
DeviceFile load_device(const std::string& name, const std::vector<std::filesystem::path>& preset_folders);

/// The family alone, with totals that are not known: "7-series" from `devices/family`.
DeviceFile load_family(const std::string& name, const std::vector<std::filesystem::path>& preset_folders);

/// Names of the devices there are.
std::vector<std::string> device_names(const std::vector<std::filesystem::path>& preset_folders);

}  // namespace parallax
