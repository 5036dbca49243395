// SPDX-License-Identifier: Apache-2.0
#include "platform/estimate/device_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "platform/config/preset.hpp"
#include "platform/config/schema.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

namespace fs = std::filesystem;

constexpr IntegerRange kCount{0, 1'000'000'000};
constexpr RealRange kWeight{0, 1e6};
constexpr RealRange kLuts{-1e6, 1e6};
constexpr std::int64_t kMostWords = std::int64_t{1} << 24;
constexpr std::int64_t kMostBits = 4096;
constexpr const char* kNone = "none";

[[noreturn]] void refuse(const std::string& key, const std::string& text) {
  throw UserError(fmt::format(
      "{} = \"{}\": expected shapes as words x bits, as in \"2048x9, 1024x18\", words up to {} and bits up "
      "to {}, or \"none\"",
      key, excerpt(text), kMostWords, kMostBits));
}

RamShape shape(const std::string& key, const std::string& all, std::string_view word) {
  const auto blank = [](char c) { return c == ' '; };
  while (!word.empty() && blank(word.front())) word.remove_prefix(1);
  while (!word.empty() && blank(word.back())) word.remove_suffix(1);
  RamShape read;
  const char* const end = word.data() + word.size();
  const auto words = std::from_chars(word.data(), end, read.words);
  if (words.ec != std::errc() || words.ptr == end || *words.ptr != 'x') refuse(key, all);
  const auto bits = std::from_chars(words.ptr + 1, end, read.bits);
  if (bits.ec != std::errc() || bits.ptr != end) refuse(key, all);
  if (read.words < 1 || read.words > kMostWords || read.bits < 1 || read.bits > kMostBits) refuse(key, all);
  return read;
}

std::vector<RamShape> shapes(const std::string& key, const std::string& text) {
  std::vector<RamShape> all;
  if (text == kNone) return all;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    all.push_back(shape(key, text, std::string_view(text).substr(begin, comma - begin)));
    begin = comma + 1;
  }
  return all;
}

void describe_ram(Schema& schema, const std::string& section, const std::string& what, RamKind& ram) {
  const Provenance origin = stated("a device file says it");
  schema.text(section + ".shapes", ram.shapes_text, "Words x bits that " + what + " can be; or none.",
              origin);
  schema.integer(section + ".units", ram.units, {1, 1'000'000}, "",
                 "What " + what + " takes of the device: units of block RAM, or LUTs.", origin);
  schema.real(section + ".weight", ram.weight, kWeight, "",
              "Weight of " + what + " when a memory's kind is chosen: the least sum is.", origin);
  schema.real(section + ".width_weight", ram.width_weight, kWeight, "",
              "Further weight of " + what + " by the share of its width that is used.", origin);
}

std::vector<fs::path> below(const std::vector<fs::path>& folders, const char* name) {
  std::vector<fs::path> all;
  for (const fs::path& folder : folders) all.push_back(folder / name);
  return all;
}

DeviceFile load(const std::string& name, const std::vector<fs::path>& folders, const std::string& what) {
  DeviceFile device;
  device.name = name;
  device.block_ram.shapes_text = device.double_block_ram.shapes_text = device.lut_ram.shapes_text = kNone;
  Schema schema;
  describe(schema, device);
  const RawConfig values = load_preset(name, folders, what);
  schema.apply(values);
  for (const Key& key : schema.keys()) {
    if (key.section() == "device" || values.find(key.path) != values.end()) continue;
    throw UserError(fmt::format(
        "{} {} does not state {}, nor does what it inherits; with inherits = \"zynq-7020\" it has all keys",
        what, excerpt(name), key.path));
  }
  device.block_ram.shapes = shapes("block_ram.shapes", device.block_ram.shapes_text);
  device.double_block_ram.shapes = shapes("double_block_ram.shapes", device.double_block_ram.shapes_text);
  device.lut_ram.shapes = shapes("lut_ram.shapes", device.lut_ram.shapes_text);
  return device;
}

}  // namespace

void describe(Schema& schema, DeviceFile& device) {
  const Provenance origin = stated("a device file says it");
  const auto total = [&](const char* name, std::int64_t& field, const char* unit, const char* what) {
    schema.integer(std::string("device.") + name, field, kCount, unit, what, origin);
  };
  total("luts", device.totals.luts, "LUTs", "LUTs of the device; 0, here and below: not known, not judged.");
  total("memory_luts", device.totals.memory_luts, "LUTs", "Of these, that can be memory or shift registers.");
  total("registers", device.totals.registers, "FFs", "Flip-flops.");
  total("block_rams", device.totals.block_rams, "blocks",
        "Block RAMs, in the unit that family.block_ram names.");
  total("dsps", device.totals.dsps, "DSPs", "DSP blocks.");

  schema.text("family.name", device.family, "The family.", origin);
  schema.text("family.block_ram", device.block_ram_unit, "Name of the smallest block RAM.", origin);
  schema.boolean("family.calibrated", device.calibrated,
                 "Whether the costs of circuits were fitted to what was synthesised for this family.",
                 origin);
  schema.real("family.register_weight", device.register_weight, kWeight, "",
              "Weight of a bit of a memory that is made of registers, beside those of RAMs.", origin);
  schema.real("family.multiplexer_weight", device.multiplexer_weight, kWeight, "",
              "Weight of a bit of a choice of two behind a memory's banks.", origin);
  schema.real("family.bank_weight", device.bank_weight, kWeight, "",
              "Weight of the decoding of a bank of RAM.", origin);
  schema.integer("family.shift_register_words", device.shift_register_words, {0, 1024}, "bits",
                 "Length of the shift register that a LUT can be; 0: none.", origin);
  schema.integer("family.multiplier_a_bits", device.multiplier_a_bits, {1, 256}, "bits",
                 "Unsigned bits of one operand of a DSP's multiplier.", origin);
  schema.integer("family.multiplier_b_bits", device.multiplier_b_bits, {1, 256}, "bits",
                 "Unsigned bits of the other one.", origin);
  schema.integer("family.multiplier_least_bits", device.multiplier_least_bits, {1, 256}, "bits",
                 "Least bits of an operand, beyond whole DSPs, that take another DSP.", origin);
  schema.integer("family.collision_registers", device.collision_registers, {0, 16}, "FFs",
                 "Registers of a bit of a block RAM that may be written where it is read.", origin);
  describe_ram(schema, "block_ram", "one block RAM", device.block_ram);
  describe_ram(schema, "double_block_ram", "two block RAMs together", device.double_block_ram);
  describe_ram(schema, "lut_ram", "one RAM of LUTs", device.lut_ram);
  for (const CircuitCost& cost : circuit_costs()) {
    schema.real("circuit." + cost.key, device.costs.*cost.member, kLuts, "LUTs", cost.documentation, origin);
  }
}

DeviceFile load_device(const std::string& name, const std::vector<fs::path>& preset_folders) {
  DeviceFile device = load(name, below(preset_folders, "devices"), "device");
  const DeviceTotals& has = device.totals;
  if (has.luts == 0 && has.registers == 0 && has.block_rams == 0 && has.dsps == 0) {
    throw UserError(fmt::format(
        "device {} states no total; set device.luts, device.block_rams, device.registers or device.dsps",
        excerpt(name)));
  }
  return device;
}

DeviceFile load_family(const std::string& name, const std::vector<fs::path>& preset_folders) {
  return load(name, below(below(preset_folders, "devices"), "family"), "family");
}

std::vector<std::string> device_names(const std::vector<fs::path>& preset_folders) {
  std::vector<std::string> names;
  for (const PresetSummary& device : list_presets(below(preset_folders, "devices")))
    names.push_back(device.name);
  return names;
}

}  // namespace parallax
