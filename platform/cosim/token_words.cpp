// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/token_words.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tlm/error.hpp"

namespace parallax {
namespace {

std::uint64_t lowest(std::size_t bits) {
  return bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
}

}  // namespace

std::string TokenWords::append_hex(const char* begin, const char* end) {
  constexpr std::size_t kDigit = 4;
  append();
  const std::size_t base = bits_.size() - stride_;
  std::size_t low = 0;
  for (const char* at = end; at != begin;) {
    const char c = *--at;
    if (c == '_') continue;
    std::uint64_t digit = 0;
    bool is_unknown = false;
    if (c >= '0' && c <= '9') {
      digit = c - '0';
    } else if ((c | 0x20) >= 'a' && (c | 0x20) <= 'f') {
      digit = (c | 0x20) - 'a' + 10;
    } else if (c == 'x' || c == 'X' || c == 'z' || c == 'Z' || c == '?') {
      is_unknown = true;
    } else {
      return fmt::format("'{}' is no hexadecimal number",
                         excerpt({begin, static_cast<std::size_t>(end - begin)}));
    }
    if (low >= width_ || (!is_unknown && low + kDigit > width_ && digit >> (width_ - low) != 0)) {
      if (digit == 0 && !is_unknown) continue;
      return fmt::format("'{}' has more than {} bits",
                         excerpt({begin, static_cast<std::size_t>(end - begin)}), width_);
    }
    if (is_unknown) {
      if (unknown_.empty()) unknown_.resize(bits_.size());
      unknown_[base + low / kWord] |= lowest(std::min(kDigit, width_ - low)) << (low % kWord);
    } else {
      bits_[base + low / kWord] |= digit << (low % kWord);
    }
    low += kDigit;
  }
  return "";
}

std::string TokenWords::append_binary(const std::string& digits) {
  append();
  const auto is_unknown = [](char c) { return c != '0' && c != '1'; };
  for (std::size_t i = 0; i < digits.size(); ++i) {
    const std::size_t index = digits.size() - 1 - i;
    if (index >= width_) {
      if (digits[i] != '0') return fmt::format("{} binary digits for {} bits", digits.size(), width_);
      continue;
    }
    set_bit(index, digits[i] == '1', is_unknown(digits[i]));
  }
  for (std::size_t index = digits.size(); index < width_ && !digits.empty() && is_unknown(digits[0]); ++index)
    set_bit(index, false, true);
  return "";
}

void TokenWords::set_bit(std::size_t index, bool value, bool is_unknown) {
  const std::size_t at = bits_.size() - stride_ + index / kWord;
  const std::uint64_t bit = std::uint64_t{1} << (index % kWord);
  if (value) bits_[at] |= bit;
  if (!is_unknown) return;
  if (unknown_.empty()) unknown_.resize(bits_.size());
  unknown_[at] |= bit;
}

void TokenWords::set(const TokenField& field, std::uint64_t value) {
  for (std::size_t i = 0; i < field.width; ++i) set_bit(field.low + i, (value >> i & 1u) != 0, false);
}

void TokenWords::set_unknown(const TokenField& field) {
  for (std::size_t i = 0; i < field.width; ++i) set_bit(field.low + i, false, true);
}

TokenWords TokenWords::part(std::uint64_t from, std::uint64_t to) const {
  const auto copy = [&](const std::vector<std::uint64_t>& bits) {
    return std::vector<std::uint64_t>(bits.begin() + static_cast<std::ptrdiff_t>(from * stride_),
                                      bits.begin() + static_cast<std::ptrdiff_t>(to * stride_));
  };
  TokenWords out(width_, copy(bits_));
  if (!unknown_.empty()) out.unknown_ = copy(unknown_);
  return out;
}

bool TokenWords::same(std::uint64_t token, const TokenWords& other, std::uint64_t other_token) const {
  const auto mine = bits_.begin() + static_cast<std::ptrdiff_t>(token * stride_);
  const auto others = other.bits_.begin() + static_cast<std::ptrdiff_t>(other_token * stride_);
  return std::equal(mine, mine + static_cast<std::ptrdiff_t>(stride_), others) && !unknown(token) &&
         !other.unknown(other_token);
}

bool TokenWords::unknown(std::uint64_t token) const {
  if (unknown_.empty()) return false;
  const auto first = unknown_.begin() + static_cast<std::ptrdiff_t>(token * stride_);
  return std::any_of(first, first + static_cast<std::ptrdiff_t>(stride_),
                     [](std::uint64_t bits) { return bits != 0; });
}

bool TokenWords::unknown(std::uint64_t token, const TokenField& field) const {
  return !unknown_.empty() && extract(unknown_, token, field) != 0;
}

std::uint64_t TokenWords::raw(std::uint64_t token, const TokenField& field) const {
  return extract(bits_, token, field);
}

std::int64_t TokenWords::value(std::uint64_t token, const TokenField& field) const {
  const std::uint64_t bits = raw(token, field);
  const bool negative = field.is_signed && (bits >> (field.width - 1) & 1u) != 0;
  return static_cast<std::int64_t>(negative ? bits | ~lowest(field.width) : bits);
}

std::uint64_t TokenWords::extract(const std::vector<std::uint64_t>& bits, std::uint64_t token,
                                  const TokenField& field) const {
  const std::size_t at = token * stride_ + field.low / kWord;
  const std::size_t shift = field.low % kWord;
  std::uint64_t value = bits[at] >> shift;
  if (shift + field.width > kWord) value |= bits[at + 1] << (kWord - shift);
  return value & lowest(field.width);
}

}  // namespace parallax
