// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "modules/token_format.hpp"

namespace parallax {

/// Tokens as they lie on the wires, one after the other, all of one width. A bit may be unknown (x or z), as
/// simulators have it.
class TokenWords {
 public:
  explicit TokenWords(std::size_t width) : width_(width), stride_((width + kWord - 1) / kWord) {}

  /// Of words that lie one after the other, each in whole words of 64 bits; all bits are known.
  TokenWords(std::size_t width, std::vector<std::uint64_t> bits) : TokenWords(width) {
    bits_ = std::move(bits);
  }

  /// Makes room for so many.
  void reserve(std::uint64_t tokens) { bits_.reserve(tokens * stride_); }

  std::size_t width() const { return width_; }  ///< bits
  std::uint64_t size() const { return bits_.size() / stride_; }

  /// Appends a word of zeros; its bits are then set.
  void append() {
    bits_.resize(bits_.size() + stride_);
    if (!unknown_.empty()) unknown_.resize(bits_.size());
  }
  /// Appends the word of these bits, bit 0 lowest in the first of them; all are known.
  void append(const std::vector<std::uint64_t>& bits) {
    bits_.insert(bits_.end(), bits.begin(), bits.begin() + static_cast<std::ptrdiff_t>(stride_));
    if (!unknown_.empty()) unknown_.resize(bits_.size());
  }
  /// Appends the word of these hexadecimal digits, x, z and '_'. Returns what is wrong with them, or "".
  std::string append_hex(const char* begin, const char* end);
  /// The same of binary digits, the highest first; missing ones are as VCD says (0, or x and z go on).
  std::string append_binary(const std::string& digits);
  /// Sets a field of the last word. Needs a value that it has place for.
  void set(const TokenField& field, std::uint64_t value);
  void set_unknown(const TokenField& field);

  /// Those from `from` to before `to`. Needs from <= to <= size().
  TokenWords part(std::uint64_t from, std::uint64_t to) const;
  /// As append() takes them.
  void read(std::uint64_t token, std::vector<std::uint64_t>& bits) const {
    const auto begin = bits_.begin() + static_cast<std::ptrdiff_t>(token * stride_);
    bits.assign(begin, begin + static_cast<std::ptrdiff_t>(stride_));
  }
  bool same(std::uint64_t token, const TokenWords& other, std::uint64_t other_token) const;
  bool unknown(std::uint64_t token) const;  ///< some bit of it
  bool unknown(std::uint64_t token, const TokenField& field) const;
  /// Unknown bits are 0.
  std::uint64_t raw(std::uint64_t token, const TokenField& field) const;
  /// With its sign.
  std::int64_t value(std::uint64_t token, const TokenField& field) const;
  bool bit(std::uint64_t token, std::size_t index) const {
    return (bits_[token * stride_ + index / kWord] >> (index % kWord) & 1u) != 0;
  }

 private:
  static constexpr std::size_t kWord = 64;

  void set_bit(std::size_t index, bool value, bool is_unknown);
  std::uint64_t extract(const std::vector<std::uint64_t>& bits, std::uint64_t token,
                        const TokenField& field) const;

  std::size_t width_;
  std::size_t stride_;  // words of 64 bits that a token takes
  std::vector<std::uint64_t> bits_;
  std::vector<std::uint64_t> unknown_;  // as long, or empty: all are known
};

}  // namespace parallax
