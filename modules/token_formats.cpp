// SPDX-License-Identifier: Apache-2.0
#include "modules/token_formats.hpp"

#include <string>

namespace parallax {

int bits_for(std::int64_t largest) {
  int bits = 1;
  while ((largest >> bits) != 0) ++bits;
  return bits;
}

TokenFormat gray_format() { return TokenFormat().field("grey", 8); }

TokenFormat offset_pair_format(std::size_t offset_bits) {
  TokenFormat format;
  for (const char* name : {"left_dx", "left_dy", "right_dx", "right_dy"}) {
    format.field(name, offset_bits, true);
  }
  return format;
}

TokenFormat census_code_format(std::size_t code_bits) { return TokenFormat().field("code", code_bits); }

TokenFormat cost_group_format(std::size_t costs, std::size_t cost_bits) {
  return TokenFormat().fields("cost", costs, cost_bits);
}

TokenFormat disparity_format() { return TokenFormat().field("disparity", kDisparityBits); }

TokenFormat path_record_format(std::size_t paths, std::size_t costs, std::size_t path_bits) {
  TokenFormat format;
  for (std::size_t path = 0; path < paths; ++path) {
    const std::string name = "path_" + std::to_string(path);
    format.fields(name + "_cost", costs, path_bits).field(name + "_minimum", path_bits);
  }
  return format;
}

TokenFormat frame_record_format(std::size_t costs, std::size_t sum_bits, std::size_t code_bits) {
  TokenFormat format;
  if (sum_bits > 0) format.fields("sum", costs, sum_bits);
  return format.field("left_code", code_bits).field("right_code", code_bits);
}

TokenFormat word_format(std::size_t bytes) { return TokenFormat().fields("byte", bytes, 8); }

BitVector pack(const TokenFormat& gray, Gray value) {
  BitVector bus = gray.bus();
  gray.set(bus, 0, value);
  return bus;
}

BitVector pack(const TokenFormat& offset_pair, const OffsetPair& value) {
  BitVector bus = offset_pair.bus();
  offset_pair.set(bus, 0, value.left.dx);
  offset_pair.set(bus, 1, value.left.dy);
  offset_pair.set(bus, 2, value.right.dx);
  offset_pair.set(bus, 3, value.right.dy);
  return bus;
}

BitVector pack_code(const TokenFormat& census_code, CensusCode value) {
  BitVector bus = census_code.bus();
  census_code.set(bus, 0, value);
  return bus;
}

BitVector pack_costs(const TokenFormat& cost_group, const Cost* values) {
  BitVector bus = cost_group.bus();
  for (std::size_t i = 0; i < cost_group.all().size(); ++i) cost_group.set(bus, i, values[i]);
  return bus;
}

BitVector pack(const TokenFormat& disparity, const Disparity& value) {
  BitVector bus = disparity.bus();
  disparity.set(bus, 0, value.value);
  return bus;
}

Gray unpack_gray(const TokenFormat& gray, const BitVector& bus) {
  return static_cast<Gray>(gray.get(bus, 0));
}

OffsetPair unpack_offset_pair(const TokenFormat& offset_pair, const BitVector& bus) {
  const auto field = [&](std::size_t index) {
    return static_cast<std::int16_t>(offset_pair.get(bus, index));
  };
  return {{field(0), field(1)}, {field(2), field(3)}};
}

CensusCode unpack_code(const TokenFormat& census_code, const BitVector& bus) {
  return static_cast<CensusCode>(census_code.get(bus, 0));
}

void unpack_costs(const TokenFormat& cost_group, const BitVector& bus, Cost* values) {
  for (std::size_t i = 0; i < cost_group.all().size(); ++i) {
    values[i] = static_cast<Cost>(cost_group.get(bus, i));
  }
}

Disparity unpack_disparity(const TokenFormat& disparity, const BitVector& bus) {
  return {static_cast<std::uint16_t>(disparity.get(bus, 0)), Cause::kMatched};
}

}  // namespace parallax
