// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/doubled_tokens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "platform/cosim/pattern_evidence.hpp"

namespace parallax {
namespace {

// More of all tokens than 1 in so many is no fault here and there.
constexpr std::uint64_t kLeastApart = 3;

struct Doubled {
  std::uint64_t number = 0, first = 0;
  std::uint64_t missing = 0;  // of the model's, at the end
};

// A token that comes twice shows where the next one should come; in a run of equal ones, at its end.
std::optional<Doubled> walk(const TokenWords& expected, const TokenWords& got) {
  Doubled found;
  std::uint64_t from = 0;
  bool was_twice = false;
  for (std::uint64_t at = 0; at < got.size(); ++at) {
    if (from < expected.size() && got.same(at, expected, from)) {
      ++from;
      was_twice = false;
      continue;
    }
    if (at == 0 || was_twice || !got.same(at, got, at - 1)) return std::nullopt;
    was_twice = true;
    if (found.number++ == 0) found.first = from - 1;
    if (found.number > got.size() / kLeastApart) return std::nullopt;
  }
  found.missing = expected.size() - from;
  return found;
}

// Whether, as far as there are some, each token `period - 1`, `2 * period - 1` and so on comes twice.
bool is_each(std::uint64_t period, const TokenWords& expected, const TokenWords& got) {
  for (std::uint64_t i = 0; i < got.size(); ++i) {
    const std::uint64_t block = i / (period + 1), in_block = i % (period + 1);
    const std::uint64_t from = block * period + std::min(in_block, period - 1);
    if (from < expected.size() && !got.same(i, expected, from)) return false;
  }
  return true;
}

}  // namespace

std::optional<DifferencePattern> find_doubled_tokens(const TokenComparison& comparison,
                                                     const TokenWords& expected, const TokenWords& got) {
  if (comparison.different_tokens < kLeastMoved) return std::nullopt;
  const std::optional<Doubled> found = walk(expected, got);
  if (!found || found->number < kLeastExplained) return std::nullopt;
  const std::string end =
      found->missing == 0 ? "" : fmt::format(", and the last {} are not there", found->missing);
  const std::uint64_t most = found->first + 1;
  for (std::uint64_t period = 2; period <= most; ++period) {
    if (most % period == 0 && is_each(period, expected, got)) {
      return DifferencePattern{
          "tokens_doubled",
          fmt::format("the last of every {} tokens comes twice, {} in all{}", period, found->number, end)};
    }
  }
  const ValuePlace place = comparison.manifest->place(*comparison.stream, found->first, 0);
  const std::string where = place.row < 0 ? "" : fmt::format(", row {}, column {}", place.row, place.column);
  return DifferencePattern{
      "tokens_doubled",
      fmt::format("{} tokens come twice, the first one token {} (frame {}{}), all others are there once{}",
                  found->number, found->first, place.frame, where, end)};
}

}  // namespace parallax
