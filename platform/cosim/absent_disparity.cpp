// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/absent_disparity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "modules/pixel.hpp"
#include "platform/cosim/pattern_evidence.hpp"

namespace parallax {

std::optional<DifferencePattern> find_absent_disparity(const TokenComparison& comparison,
                                                       const TokenWords& expected, const TokenWords& got) {
  const std::vector<TokenField>& fields = comparison.stream->shape.format.all();
  const TokenField& field = fields.front();
  if (fields.size() > 1 || field.name.rfind("disparity", 0) != 0 || comparison.unknown_tokens > 0 ||
      comparison.different_tokens < kLeastMoved)
    return std::nullopt;
  const auto whole = [&field](const TokenWords& words, std::uint64_t token) {
    return words.raw(token, field) >> kDisparityFractionBits;
  };
  const std::uint64_t absent = whole(expected, comparison.first->token);
  if (absent == kInvalidDisparity >> kDisparityFractionBits) return std::nullopt;
  std::uint64_t least = absent, greatest = absent;
  for (std::uint64_t token = 0; token < comparison.compared_tokens; ++token) {
    const std::uint64_t its = whole(expected, token);
    const bool differs = !got.same(token, expected, token);
    if (differs != (its == absent) || whole(got, token) == absent) return std::nullopt;
    if (expected.raw(token, field) == kInvalidDisparity) continue;
    least = std::min(least, its);
    greatest = std::max(greatest, its);
  }
  if (least == greatest || (absent != least && absent != greatest)) return std::nullopt;
  return DifferencePattern{
      "disparity_never_wins",
      fmt::format("all that differ have the disparity {} px in the model, its {}, which is nowhere in the "
                  "circuit's: it never wins",
                  absent, absent == least ? "least" : "greatest")};
}

}  // namespace parallax
