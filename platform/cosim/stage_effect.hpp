// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "platform/cosim/token_words.hpp"
#include "platform/cosim/vector_manifest.hpp"

namespace parallax {

/// The model's tokens of a stream of the manifest; nullptr where they are not at hand.
using ModelTokens = std::function<const TokenWords*(const VectorStream&)>;

/// Whether two streams have tokens of the same fields at the same pixels, so that they may be compared, or
/// exchanged.
bool are_alike(const VectorStream& a, const VectorStream& b);

/// What the model's stage does with these images: where that is little, a circuit that does nothing is equal
/// to it.
struct StageEffect {
  /// Of an output, how many tokens are not those of the input that is alike; nothing where there is none.
  /// Where several are, it is the one whose port has the same name ("in_left" of "out_left").
  std::optional<std::uint64_t> changed_tokens;
  std::string input;                         ///< that stream
  std::optional<std::int64_t> only_value{};  ///< that all values have, two or more of them
  std::uint64_t tokens = 0;
};

/// `expected`: the model's tokens of `stream`. `model` may be empty: no other stream is looked at.
StageEffect stage_effect(const VectorManifest& manifest, const VectorStream& stream,
                         const TokenWords& expected, const ModelTokens& model);

/// One line where equality says little, else nothing: all values are the same, or the stage changes less than
/// 1 in 100 tokens.
std::string text(const StageEffect& effect);
/// `changed_tokens` and `input_stream`, and `only_value`, where they are known.
void add_to(nlohmann::ordered_json& tree, const StageEffect& effect);

}  // namespace parallax
