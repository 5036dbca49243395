// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/stream_end.hpp"

#include <fmt/format.h>

#include "platform/cosim/pattern_evidence.hpp"

namespace parallax {

std::string place_text(const TokenComparison& comparison, std::uint64_t token) {
  const ValuePlace place = comparison.manifest->place(*comparison.stream, token, 0);
  const std::uint64_t before =
      static_cast<std::uint64_t>(comparison.manifest->first_frame) * comparison.stream->frame_tokens;
  if (place.row < 0) return fmt::format("token {} (frame {})", before + token, place.frame);
  return fmt::format("token {} (frame {}, row {}, column {})", before + token, place.frame, place.row,
                     place.column);
}

std::vector<DifferencePattern> find_end(const TokenComparison& comparison) {
  if (comparison.different_tokens > 0) return {};
  if (comparison.got_tokens == 0) return {{"truncated", "no token came out"}};
  if (comparison.got_tokens < comparison.expected_tokens) {
    return {{"truncated", fmt::format("it ends before {}, all before that is equal",
                                      place_text(comparison, comparison.compared_tokens))}};
  }
  return {{"surplus", "more tokens at the end, all before them are equal"}};
}

std::uint64_t constant_from(const TokenWords& words) {
  std::uint64_t from = words.size();
  while (from > 1 && words.same(from - 1, words, from - 2)) --from;
  return from == 0 ? 0 : from - 1;
}

std::optional<DifferencePattern> find_constant_end(const TokenComparison& comparison, const TokenWords& got) {
  if (comparison.different_tokens < kLeastMoved || comparison.first->token < constant_from(got))
    return std::nullopt;
  const std::vector<TokenField>& fields = comparison.stream->shape.format.all();
  const std::uint64_t first = comparison.first->token;
  return DifferencePattern{
      "constant_end",
      fmt::format("all its tokens are {} from {} on",
                  fields.size() == 1 ? std::to_string(got.value(first, fields.front())) : "the same",
                  place_text(comparison, first))};
}

}  // namespace parallax
