// SPDX-License-Identifier: Apache-2.0
#include "modules/token_format.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace parallax {
namespace {

// The value of the lowest `width` bits.
std::int64_t value_of(std::uint64_t bits, const TokenField& field) {
  if (field.width == 64) return bits;
  const std::int64_t value = bits & ((std::uint64_t{1} << field.width) - 1);
  const bool negative = field.is_signed && (bits >> (field.width - 1) & 1u) != 0;
  return negative ? value - (std::int64_t{1} << field.width) : value;
}

[[noreturn]] void has_no_place(const TokenField& field, std::int64_t value) {
  throw std::out_of_range(fmt::format("{} = {} has no place in {} bits", field.name, value, field.width));
}

}  // namespace

TokenFormat& TokenFormat::field(const std::string& name, std::size_t width, bool is_signed) {
  fields_.push_back({name, bits_, width, is_signed});
  bits_ += width;
  return *this;
}

TokenFormat& TokenFormat::fields(const std::string& name, std::size_t number, std::size_t width) {
  for (std::size_t i = 0; i < number; ++i) field(fmt::format("{}_{}", name, i), width);
  return *this;
}

TokenFormat TokenFormat::several(std::size_t number) const {
  if (number == 1) return *this;
  TokenFormat all;
  for (std::size_t i = 0; i < number; ++i) {
    for (const TokenField& one : fields_) {
      all.field(one.name + "_" + std::to_string(i), one.width, one.is_signed);
    }
  }
  return all;
}

std::int64_t TokenFormat::get(const BitVector& bus, std::size_t index) const {
  const TokenField& field = fields_.at(index);
  return value_of(bus.get(field.low, field.width), field);
}

void TokenFormat::set(BitVector& bus, std::size_t index, std::int64_t value) const {
  const TokenField& field = fields_.at(index);
  const std::uint64_t bits = value;
  if (value_of(bits, field) != value) has_no_place(field, value);
  bus.set(field.low, field.width, bits);
}

void FieldPacker::next(std::int64_t value) {
  const TokenField& field = format_.all().at(field_++);
  std::uint64_t bits = value;
  if (value_of(bits, field) != value) has_no_place(field, value);
  if (field.width < kWord) bits &= (std::uint64_t{1} << field.width) - 1;
  const std::size_t word = field.low / kWord;
  const std::size_t shift = field.low % kWord;
  bits_[word] |= bits << shift;
  if (shift + field.width > kWord) bits_[word + 1] |= bits >> (kWord - shift);
}

std::int64_t FieldUnpacker::next() {
  constexpr std::size_t kWord = 64;
  const TokenField& field = format_.all().at(field_++);
  const std::size_t word = field.low / kWord;
  const std::size_t shift = field.low % kWord;
  std::uint64_t bits = bits_[word] >> shift;
  if (shift + field.width > kWord) bits |= bits_[word + 1] << (kWord - shift);
  return value_of(bits, field);
}

}  // namespace parallax
