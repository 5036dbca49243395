// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/value_difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <set>

#include "modules/pixel.hpp"

namespace parallax {
namespace {

constexpr std::size_t kBitsThatTell = 3;
constexpr std::size_t kLeastOneWay = 16;  // tokens: all one way by chance in one of 2^15 cases

// Of the values that differ.
struct Differing {
  bool unknown = false;
  bool by_one = true;               // each
  bool validity = true;             // in each, one of the two is invalid
  std::uint64_t lost = 0;           // that should be valid and are not,
  std::uint64_t kept = 0;           // and the other way
  std::uint64_t changed = 0;        // bits
  std::set<std::uint64_t> instead;  // of invalid ones; two at most
};

Differing look_at(const VectorStream& stream, const TokenWords& expected, const TokenWords& got) {
  const std::vector<TokenField>& fields = stream.shape.format.all();
  Differing all;
  for_each_difference(stream, expected, got, [&](std::uint64_t token, std::size_t index) {
    const TokenField& field = fields[index];
    all.unknown = all.unknown || got.unknown(token, field);
    const std::uint64_t right = expected.raw(token, field), wrong = got.raw(token, field);
    all.by_one = all.by_one && std::abs(expected.value(token, field) - got.value(token, field)) == 1;
    all.validity = all.validity && (right == kInvalidDisparity || wrong == kInvalidDisparity);
    all.changed |= right ^ wrong;
    ++(right == kInvalidDisparity ? all.kept : all.lost);
    if (right == kInvalidDisparity && all.instead.size() < 2) all.instead.insert(wrong);
  });
  return all;
}

}  // namespace

std::optional<DifferencePattern> find_value_difference(const VectorStream& stream, const TokenWords& expected,
                                                       const TokenWords& got) {
  const std::vector<TokenField>& fields = stream.shape.format.all();
  const Differing all = look_at(stream, expected, got);
  if (all.unknown || all.changed == 0) return std::nullopt;
  const bool are_disparities = std::all_of(fields.begin(), fields.end(), [](const TokenField& field) {
    return field.width == static_cast<std::size_t>(kDisparityBits) && field.name.rfind("disparity", 0) == 0;
  });
  if (are_disparities && all.validity) {
    if (all.lost == 0 && all.instead.size() == 1) {
      return DifferencePattern{"invalid_as",
                               fmt::format("what is invalid has the value {}", *all.instead.begin())};
    }
    return DifferencePattern{
        "only_validity",
        fmt::format("no value is another, only which are valid: {} are that should not be, {} are not that "
                    "should be",
                    all.kept, all.lost)};
  }
  const bool are_numbers = std::all_of(fields.begin(), fields.end(), [](const TokenField& field) {
    return field.width > kBitsThatTell && field.name != "code";
  });
  if (!are_numbers) return std::nullopt;
  if (all.by_one) return DifferencePattern{"off_by_one", "what differs does so by 1: rounding"};
  std::size_t right = 0;
  while ((all.changed >> right & 1u) == 0) ++right;
  if (right < kBitsThatTell) return std::nullopt;
  return DifferencePattern{"upper_bits",
                           fmt::format("the lowest {} bits of the values are right, others differ", right)};
}

std::optional<DifferencePattern> find_one_way_bits(const VectorStream& stream, const TokenWords& expected,
                                                   const TokenWords& got) {
  const std::vector<TokenField>& fields = stream.shape.format.all();
  const bool are_codes = std::all_of(
      fields.begin(), fields.end(), [](const TokenField& field) { return field.name.rfind("code", 0) == 0; });
  if (!are_codes) return std::nullopt;
  bool unknown = false, some_set = false, some_cleared = false;
  std::uint64_t values = 0;
  std::set<std::uint64_t> instead;  // two at most
  for_each_difference(stream, expected, got, [&](std::uint64_t token, std::size_t index) {
    const std::uint64_t right = expected.raw(token, fields[index]), wrong = got.raw(token, fields[index]);
    unknown = unknown || got.unknown(token, fields[index]);
    some_set = some_set || (wrong & ~right) != 0;
    some_cleared = some_cleared || (right & ~wrong) != 0;
    if (instead.size() < 2) instead.insert(wrong);
    ++values;
  });
  if (unknown || some_set == some_cleared || values < kLeastOneWay || instead.size() < 2) return std::nullopt;
  if (some_set) {
    return DifferencePattern{
        "only_set_bits", "bits are 1 where the model's are 0, never the other way: as with <= in place of <"};
  }
  return DifferencePattern{
      "only_cleared_bits",
      "bits are 0 where the model's are 1, never the other way: as with < in place of <="};
}

}  // namespace parallax
