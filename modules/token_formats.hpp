// SPDX-License-Identifier: Apache-2.0
// How the tokens of the pipeline lie on wires, each stated once: pixel.hpp says what they mean.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "modules/pixel.hpp"
#include "modules/token_format.hpp"

namespace parallax {

/// Bits that hold every value from 0 to `largest`; at least 1.
int bits_for(std::int64_t largest);

/// A pixel: grey.
TokenFormat gray_format();
/// A pair of offsets: left_dx, left_dy, right_dx, right_dy, signed, of `offset_bits` each.
TokenFormat offset_pair_format(std::size_t offset_bits);
/// A census code: one field of `code_bits`.
TokenFormat census_code_format(std::size_t code_bits);
/// A group of path costs, summed: cost_0, cost_1, ... of `costs` disparities in rising order.
TokenFormat cost_group_format(std::size_t costs, std::size_t cost_bits);
/// A disparity: its 12-bit value, with 4 fraction bits. What made it invalid is not on the wires.
TokenFormat disparity_format();
/// What the matcher keeps of a pixel for the next row: for each path its costs, path_0_cost_0, ..., and
/// behind them the lowest of these, path_0_minimum. Paths in this order: NW, N, NE; in the second pass SE, S,
/// SW.
TokenFormat path_record_format(std::size_t paths, std::size_t costs, std::size_t path_bits);
/// What it keeps of a pixel for its second pass: sum_0, sum_1, ..., left_code, right_code; no sums if
/// `sum_bits` is 0.
TokenFormat frame_record_format(std::size_t costs, std::size_t sum_bits, std::size_t code_bits);
/// A word of a byte stream: byte_0, the first one, lowest.
TokenFormat word_format(std::size_t bytes);

// A token's value onto the wires and back. What a format has no room for is std::out_of_range.

BitVector pack(const TokenFormat& gray, Gray value);
BitVector pack(const TokenFormat& offset_pair, const OffsetPair& value);
BitVector pack_code(const TokenFormat& census_code, CensusCode value);
/// As many costs as the format has fields.
BitVector pack_costs(const TokenFormat& cost_group, const Cost* values);
BitVector pack(const TokenFormat& disparity, const Disparity& value);

/// Fields that a value takes.
template <class T>
inline constexpr std::size_t kWiredFields = 1;
template <>
inline constexpr std::size_t kWiredFields<OffsetPair> = 4;

/// A value's fields.
inline std::array<std::int64_t, 1> wired_fields(std::uint64_t value) {
  return {static_cast<std::int64_t>(value)};
}
inline std::array<std::int64_t, 1> wired_fields(const Disparity& value) { return {value.value}; }
inline std::array<std::int64_t, 4> wired_fields(const OffsetPair& value) {
  return {value.left.dx, value.left.dy, value.right.dx, value.right.dy};
}

/// The first `size` values of a token, one field after the other, into `bits`: its width, bit 0 lowest in the
/// first word; fields beyond them are 0. Needs no more values than the format has fields for.
template <class T>
void pack_values(const TokenFormat& format, const T* values, std::size_t size,
                 std::vector<std::uint64_t>& bits) {
  FieldPacker packer(format, bits);
  for (std::size_t i = 0; i < size; ++i) {
    for (const std::int64_t field : wired_fields(values[i])) packer.next(field);
  }
}

/// A value from its fields. Of a disparity's cause the wires do not tell: Cause::kMatched.
template <class T>
T value_of_fields(FieldUnpacker& fields) {
  return static_cast<T>(fields.next());
}
template <>
inline Disparity value_of_fields<Disparity>(FieldUnpacker& fields) {
  return {static_cast<std::uint16_t>(fields.next()), Cause::kMatched};
}
template <>
inline OffsetPair value_of_fields<OffsetPair>(FieldUnpacker& fields) {
  OffsetPair pair;
  for (std::int16_t* const field : {&pair.left.dx, &pair.left.dy, &pair.right.dx, &pair.right.dy})
    *field = static_cast<std::int16_t>(fields.next());
  return pair;
}

/// What pack_values() put onto the wires: the first `size` values of the token.
template <class T>
void unpack_values(const TokenFormat& format, const std::vector<std::uint64_t>& bits, T* values,
                   std::size_t size) {
  FieldUnpacker fields(format, bits);
  for (std::size_t i = 0; i < size; ++i) values[i] = value_of_fields<T>(fields);
}

Gray unpack_gray(const TokenFormat& gray, const BitVector& bus);
OffsetPair unpack_offset_pair(const TokenFormat& offset_pair, const BitVector& bus);
CensusCode unpack_code(const TokenFormat& census_code, const BitVector& bus);
void unpack_costs(const TokenFormat& cost_group, const BitVector& bus, Cost* values);
/// With Cause::kMatched, since the wires do not tell.
Disparity unpack_disparity(const TokenFormat& disparity, const BitVector& bus);

}  // namespace parallax
