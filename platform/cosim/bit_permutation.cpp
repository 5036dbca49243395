// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/bit_permutation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace parallax {
namespace {

constexpr std::size_t kLeastTokens = 64;  // two bits are alike in so many by chance once in 2^64
constexpr std::size_t kBitsTold = 6;

using Column = std::vector<bool>;  // a bit of each token

bool is_constant(const Column& column) {
  return std::all_of(column.begin(), column.end(), [&](bool bit) { return bit == column.front(); });
}

std::optional<std::size_t> rotation(const BitPermutation& permutation) {
  const std::size_t width = permutation.size(), by = (width - permutation[0]) % width;
  for (std::size_t bit = 0; bit < width; ++bit) {
    if (permutation[(bit + by) % width] != bit) return std::nullopt;
  }
  return by;
}

}  // namespace

std::optional<BitPermutation> find_bit_permutation(const TokenWords& expected, const TokenWords& got,
                                                   std::int64_t late, const std::vector<std::uint64_t>& at) {
  std::vector<std::uint64_t> tokens;
  for (const std::uint64_t token : at) {
    const std::int64_t from = static_cast<std::int64_t>(token) - late;
    if (from >= 0 && from < static_cast<std::int64_t>(expected.size()) && !got.unknown(token))
      tokens.push_back(token);
  }
  if (tokens.size() < kLeastTokens) return std::nullopt;
  const auto column = [&tokens](const TokenWords& words, std::int64_t before, std::size_t bit) {
    Column out;
    for (const std::uint64_t token : tokens)
      out.push_back(words.bit(token - static_cast<std::uint64_t>(before), bit));
    return out;
  };
  const std::size_t width = expected.width();
  std::vector<Column> mine;
  std::map<Column, std::vector<std::size_t>> bits;  // of the model's that are so
  for (std::size_t bit = 0; bit < width; ++bit) {
    mine.push_back(column(got, 0, bit));
    bits[column(expected, late, bit)].push_back(bit);
  }
  BitPermutation out(width, width);
  for (const bool must_stay : {true, false}) {
    for (std::size_t bit = 0; bit < width; ++bit) {
      const auto found = bits.find(mine[bit]);
      if (found == bits.end()) return std::nullopt;
      std::vector<std::size_t>& left = found->second;
      const auto same = std::find(left.begin(), left.end(), bit);
      if (out[bit] < width || (must_stay && same == left.end())) continue;
      if (left.empty()) return std::nullopt;
      const auto taken = must_stay ? same : left.begin();
      out[bit] = *taken;
      left.erase(taken);
    }
  }
  std::size_t moved = 0;
  for (std::size_t bit = 0; bit < width; ++bit) moved += out[bit] != bit && !is_constant(mine[bit]) ? 1 : 0;
  if (moved < 2) return std::nullopt;
  return out;
}

bool is_permuted(const BitPermutation& permutation, const TokenWords& expected, std::uint64_t from,
                 const TokenWords& got, std::uint64_t at) {
  if (got.unknown(at)) return false;
  for (std::size_t bit = 0; bit < permutation.size(); ++bit) {
    if (got.bit(at, bit) != expected.bit(from, permutation[bit])) return false;
  }
  return true;
}

std::string text(const BitPermutation& permutation) {
  if (const auto by = rotation(permutation)) {
    const bool up = 2 * *by <= permutation.size();
    return fmt::format("the bits are rotated {} by {}", up ? "up" : "down",
                       up ? *by : permutation.size() - *by);
  }
  std::string bits;
  std::size_t told = 0;
  for (std::size_t bit = 0; bit < permutation.size(); ++bit) {
    if (permutation[bit] == bit) continue;
    if (told++ == kBitsTold) return "the bits are in another order: " + bits + " and so on";
    bits += fmt::format("{}{} is the model's {}", told == 1 ? "bit " : ", ", bit, permutation[bit]);
  }
  return "the bits are in another order: " + bits;
}

}  // namespace parallax
