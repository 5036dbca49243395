// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/other_stream.hpp"

#include <fmt/format.h>

namespace parallax {
namespace {

// In all tokens that came out, of which some are others than the first.
bool has_tokens_of(const TokenWords& got, const TokenWords& other) {
  if (got.size() == 0 || got.size() > other.size()) return false;
  bool is_one_value = true;
  for (std::uint64_t token = 0; token < got.size(); ++token) {
    if (!got.same(token, other, token)) return false;
    is_one_value = is_one_value && got.same(token, other, 0);
  }
  return !is_one_value;
}

DifferencePattern told(const VectorStream& other) {
  if (other.is_input)
    return {"input_unchanged",
            fmt::format("all its tokens are those of the input {}, unchanged", other.name)};
  return {"exchanged_streams",
          fmt::format("all its tokens are those of {}: the two are exchanged, or that one is there twice",
                      other.name)};
}

}  // namespace

std::optional<DifferencePattern> find_other_stream(const TokenComparison& comparison, const TokenWords& got,
                                                   const ModelTokens& model) {
  const VectorStream& stream = *comparison.stream;
  if (!model || comparison.different_tokens == 0 || stream.is_input) return std::nullopt;
  // Of an output and an input that are the same, the output says more.
  for (const bool is_input : {false, true}) {
    for (const VectorStream& other : comparison.manifest->streams) {
      if (&other == &stream || other.is_input != is_input || !are_alike(other, stream)) continue;
      const TokenWords* const words = model(other);
      if (words != nullptr && has_tokens_of(got, *words)) return told(other);
    }
  }
  return std::nullopt;
}

}  // namespace parallax
