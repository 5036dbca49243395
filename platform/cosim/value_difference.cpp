// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/value_difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <set>

#include "modules/pixel.hpp"
#include "platform/cosim/pattern_evidence.hpp"

namespace parallax {
namespace {

constexpr std::size_t kBitsThatTell = 3;
constexpr std::size_t kLeastOneWay = 16;  // tokens: all one way by chance in one of 2^15 cases

// Of the values that differ.
struct Differing {
  bool unknown = false;
  bool by_one = true;                              // each
  bool validity = true;                            // in each, one of the two is invalid
  bool some_higher = false, some_lower = false;    // than the model's
  std::uint64_t lost = 0;                          // that should be valid and are not,
  std::uint64_t kept = 0;                          // and the other way
  std::uint64_t changed = 0;                       // bits
  std::map<std::uint64_t, std::uint64_t> instead;  // of invalid ones, how often
};

Differing look_at(const VectorStream& stream, const TokenWords& expected, const TokenWords& got) {
  const std::vector<TokenField>& fields = stream.shape.format.all();
  Differing all;
  for_each_difference(stream, expected, got, [&](std::uint64_t token, std::size_t index) {
    const TokenField& field = fields[index];
    all.unknown = all.unknown || got.unknown(token, field);
    const std::uint64_t right = expected.raw(token, field), wrong = got.raw(token, field);
    const std::int64_t by = got.value(token, field) - expected.value(token, field);
    all.by_one = all.by_one && std::abs(by) == 1;
    (by > 0 ? all.some_higher : all.some_lower) = true;
    all.validity = all.validity && (right == kInvalidDisparity || wrong == kInvalidDisparity);
    all.changed |= right ^ wrong;
    ++(right == kInvalidDisparity ? all.kept : all.lost);
    if (right == kInvalidDisparity) ++all.instead[wrong];
  });
  return all;
}

// The value that stands for none: the most frequent one where the model's is invalid, if none is invalid in
// the circuit's, which may have more of them.
struct InvalidAs {
  std::uint64_t value = 0;
  std::uint64_t kept = 0, lost = 0;  // as in Differing, with that number for none
};
std::optional<InvalidAs> invalid_as(const VectorStream& stream, const TokenWords& expected,
                                    const TokenWords& got, const Differing& all) {
  if (all.kept < kLeastExplained) return std::nullopt;
  const auto most = std::max_element(all.instead.begin(), all.instead.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  if (2 * most->second <= all.kept) return std::nullopt;
  InvalidAs found{most->first, all.kept - most->second, 0};
  for (std::uint64_t token = 0; token < std::min(expected.size(), got.size()); ++token) {
    for (const TokenField& field : stream.shape.format.all()) {
      const std::uint64_t right = expected.raw(token, field), wrong = got.raw(token, field);
      if (wrong == kInvalidDisparity) return std::nullopt;
      if (right == wrong || right == kInvalidDisparity) continue;
      if (wrong != found.value) return std::nullopt;
      ++found.lost;
    }
  }
  return found;
}

DifferencePattern only_validity(std::uint64_t kept, std::uint64_t lost) {
  return {"only_validity",
          fmt::format("no value is another, only which are valid: {} are that should not be, {} are not that "
                      "should be",
                      kept, lost)};
}

const char* way_of(const Differing& all) {
  if (all.some_higher && all.some_lower) return "by 1, some too high and some too low";
  return all.some_higher ? "by 1, all too high" : "by 1, all too low";
}

}  // namespace

std::vector<DifferencePattern> find_validity(const VectorStream& stream, const TokenWords& expected,
                                             const TokenWords& got) {
  const std::vector<TokenField>& fields = stream.shape.format.all();
  const bool are_disparities = std::all_of(fields.begin(), fields.end(), [](const TokenField& field) {
    return field.width == static_cast<std::size_t>(kDisparityBits) && field.name.rfind("disparity", 0) == 0;
  });
  if (!are_disparities) return {};
  const Differing all = look_at(stream, expected, got);
  if (all.unknown || all.changed == 0) return {};
  if (const auto found = invalid_as(stream, expected, got, all)) {
    std::vector<DifferencePattern> patterns{
        {"invalid_as", fmt::format("what is invalid has the value {}", found->value)}};
    if (found->kept + found->lost > 0) patterns.push_back(only_validity(found->kept, found->lost));
    return patterns;
  }
  if (all.validity) return {only_validity(all.kept, all.lost)};
  return {};
}

std::optional<DifferencePattern> find_value_difference(const VectorStream& stream, const TokenWords& expected,
                                                       const TokenWords& got) {
  const std::vector<TokenField>& fields = stream.shape.format.all();
  const Differing all = look_at(stream, expected, got);
  if (all.unknown || all.changed == 0) return std::nullopt;
  const bool are_numbers = std::all_of(fields.begin(), fields.end(), [](const TokenField& field) {
    return field.width > kBitsThatTell && field.name != "code";
  });
  if (!are_numbers) return std::nullopt;
  if (all.by_one)
    return DifferencePattern{"off_by_one", fmt::format("what differs does so {}: rounding", way_of(all))};
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
