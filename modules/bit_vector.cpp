// SPDX-License-Identifier: Apache-2.0
#include "modules/bit_vector.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace parallax {
namespace {

constexpr std::size_t kByte = 8;

std::uint64_t lowest(std::size_t bits) {
  return bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
}

}  // namespace

void BitVector::check(std::size_t low, std::size_t width) const {
  if (width >= 1 && width <= kWord && low <= width_ && width <= width_ - low) return;
  throw std::out_of_range(fmt::format("{} bits from bit {} of a bus of {}", width, low, width_));
}

std::uint64_t BitVector::get(std::size_t low, std::size_t width) const {
  check(low, width);
  const std::size_t word = low / kWord;
  const std::size_t shift = low % kWord;
  std::uint64_t value = words_[word] >> shift;
  if (shift + width > kWord) value |= words_[word + 1] << (kWord - shift);
  return value & lowest(width);
}

void BitVector::set(std::size_t low, std::size_t width, std::uint64_t value) {
  check(low, width);
  value &= lowest(width);
  const std::size_t word = low / kWord;
  const std::size_t shift = low % kWord;
  words_[word] = (words_[word] & ~(lowest(width) << shift)) | value << shift;
  if (shift + width <= kWord) return;
  const std::size_t done = kWord - shift;
  words_[word + 1] = (words_[word + 1] & ~lowest(width - done)) | value >> done;
}

std::vector<std::uint8_t> BitVector::bytes() const {
  std::vector<std::uint8_t> all;
  all.reserve((width_ + kByte - 1) / kByte);
  for (std::size_t low = 0; low < width_; low += kByte) {
    all.push_back(static_cast<std::uint8_t>(words_[low / kWord] >> (low % kWord)));
  }
  return all;
}

BitVector BitVector::from_bytes(const std::uint8_t* bytes, std::size_t width) {
  BitVector bits(width);
  for (std::size_t low = 0; low < width; low += kByte) {
    bits.set(low, width - low < kByte ? width - low : kByte, bytes[low / kByte]);
  }
  return bits;
}

}  // namespace parallax
