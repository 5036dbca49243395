// SPDX-License-Identifier: Apache-2.0
#include "platform/estimate/memory_mapping.hpp"

#include <algorithm>
#include <cmath>

namespace parallax {
namespace {

constexpr std::int64_t kLeastShift = 3;  // steps: yosys' shregmap leaves shorter delays in registers

std::int64_t whole(std::int64_t amount, std::int64_t of) { return (amount + of - 1) / of; }

std::int64_t power_of_two(std::int64_t least) {
  std::int64_t power = 1;
  while (power < least) power *= 2;
  return power;
}

// The best mapping so far.
struct Choice {
  double weight;
  MemoryMapping mapping;
};

double multiplexer_weight(std::int64_t banks, std::int64_t bits, const DeviceFile& device) {
  return device.multiplexer_weight * static_cast<double>((banks - 1) * bits);
}

std::int64_t multiplexer_luts(std::int64_t banks, std::int64_t bits, const DeviceFile& device) {
  if (banks == 1) return 0;
  return std::llround(device.costs.bank_multiplexer * static_cast<double>(power_of_two(banks) * bits));
}

void consider(const MemoryShape& memory, const RamKind& kind, MemoryMapping::Kind as,
              const DeviceFile& device, Choice& best) {
  for (const RamShape& shape : kind.shapes) {
    const std::int64_t beside = whole(memory.bits, shape.bits);
    const std::int64_t banks = whole(memory.words, shape.words);
    const double width = static_cast<double>(memory.bits) / static_cast<double>(shape.bits);
    const double weight =
        static_cast<double>(banks) * (static_cast<double>(beside) * kind.weight + width * kind.width_weight) +
        multiplexer_weight(banks, memory.bits, device) + device.bank_weight * static_cast<double>(banks);
    if (weight >= best.weight) continue;
    Resources made;
    made.logic_luts = multiplexer_luts(banks, memory.bits, device);
    const std::int64_t units = beside * banks * kind.units;
    if (as == MemoryMapping::Kind::kBlockRam) {
      made.block_rams = units;
      if (memory.may_collide) made.registers = device.collision_registers * memory.bits;
    } else {
      made.ram_luts = units;
      if (memory.read == MemoryShape::Read::kRegistered) made.registers = memory.bits;
    }
    best = {weight, {as, made}};
  }
}

}  // namespace

MemoryMapping map_memory(const MemoryShape& memory, const DeviceFile& device) {
  if (memory.words <= 0 || memory.bits <= 0) return {};
  Resources registers;
  registers.registers =
      memory.words * memory.bits + (memory.read == MemoryShape::Read::kRegistered ? memory.bits : 0);
  registers.logic_luts = multiplexer_luts(memory.words, memory.bits, device);
  Choice best{device.register_weight * static_cast<double>(memory.words * memory.bits) +
                  multiplexer_weight(memory.words, memory.bits, device),
              {MemoryMapping::Kind::kRegisters, registers}};
  consider(memory, device.lut_ram, MemoryMapping::Kind::kLutRam, device, best);
  if (memory.read == MemoryShape::Read::kRegistered) {
    consider(memory, device.block_ram, MemoryMapping::Kind::kBlockRam, device, best);
    consider(memory, device.double_block_ram, MemoryMapping::Kind::kBlockRam, device, best);
  }
  return best.mapping;
}

Resources map_delay(std::int64_t steps, std::int64_t bits, const DeviceFile& device) {
  Resources made;
  if (steps < kLeastShift || device.shift_register_words == 0) {
    made.registers = steps * bits;
  } else {
    made.shift_luts = whole(steps, device.shift_register_words) * bits;
  }
  return made;
}

std::int64_t multipliers(std::int64_t bits, std::int64_t other_bits, const DeviceFile& device) {
  const auto parts = [&](std::int64_t operand, std::int64_t of) {
    const bool rest = operand % of >= device.multiplier_least_bits;
    return std::max<std::int64_t>(1, operand / of + (rest ? 1 : 0));
  };
  return parts(std::max(bits, other_bits), device.multiplier_a_bits) *
         parts(std::min(bits, other_bits), device.multiplier_b_bits);
}

}  // namespace parallax
