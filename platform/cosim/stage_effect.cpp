// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/stage_effect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace parallax {
namespace {

constexpr std::uint64_t kFewOf = 100;  // less than 1 of so many tokens changed: equal says little

// "left" of "in_left" and of "out_left".
std::string side(const std::string& port) { return port.substr(port.find('_') + 1); }

const VectorStream* input_alike(const VectorManifest& manifest, const VectorStream& stream) {
  std::vector<const VectorStream*> alike;
  for (const VectorStream& other : manifest.streams) {
    if (!other.is_input || !are_alike(other, stream)) continue;
    if (side(other.port) == side(stream.port)) return &other;
    alike.push_back(&other);
  }
  return alike.size() == 1 ? alike.front() : nullptr;
}

std::optional<std::int64_t> only_value(const std::vector<TokenField>& fields, const TokenWords& words) {
  if (words.size() * fields.size() < 2) return std::nullopt;
  const std::int64_t first = words.value(0, fields.front());
  for (std::uint64_t token = 0; token < words.size(); ++token) {
    for (const TokenField& field : fields) {
      if (words.value(token, field) != first) return std::nullopt;
    }
  }
  return first;
}

std::uint64_t different(const TokenWords& a, const TokenWords& b) {
  std::uint64_t number = 0;
  for (std::uint64_t token = 0; token < a.size(); ++token) number += a.same(token, b, token) ? 0 : 1;
  return number;
}

}  // namespace

bool are_alike(const VectorStream& a, const VectorStream& b) {
  const std::vector<TokenField>&mine = a.shape.format.all(), &others = b.shape.format.all();
  return a.tokens == b.tokens && a.frame_tokens == b.frame_tokens && a.is_tap == b.is_tap &&
         a.shape.row_tokens == b.shape.row_tokens && a.shape.tokens_per_pixel == b.shape.tokens_per_pixel &&
         a.shape.pixels_per_token == b.shape.pixels_per_token && a.shape.order == b.shape.order &&
         std::equal(mine.begin(), mine.end(), others.begin(), others.end(),
                    [](const TokenField& x, const TokenField& y) {
                      return x.name == y.name && x.width == y.width && x.is_signed == y.is_signed;
                    });
}

StageEffect stage_effect(const VectorManifest& manifest, const VectorStream& stream,
                         const TokenWords& expected, const ModelTokens& model) {
  StageEffect effect;
  effect.tokens = expected.size();
  effect.only_value = only_value(stream.shape.format.all(), expected);
  if (!model || stream.is_input || stream.is_tap) return effect;
  const VectorStream* const input = input_alike(manifest, stream);
  const TokenWords* const words = input != nullptr ? model(*input) : nullptr;
  if (words == nullptr || words->size() != expected.size()) return effect;
  effect.changed_tokens = different(expected, *words);
  effect.input = input->name;
  return effect;
}

std::string text(const StageEffect& effect) {
  std::string said;
  if (effect.only_value) said = fmt::format("all values of the model are {}", *effect.only_value);
  if (effect.changed_tokens && *effect.changed_tokens * kFewOf < effect.tokens) {
    said += fmt::format("{}the stage changes {} of {} tokens of {}", said.empty() ? "" : ", ",
                        *effect.changed_tokens, effect.tokens, effect.input);
  }
  return said.empty() ? said : fmt::format("equal says little   {}\n", said);
}

void add_to(nlohmann::ordered_json& tree, const StageEffect& effect) {
  if (effect.changed_tokens) {
    tree["changed_tokens"] = *effect.changed_tokens;
    tree["input_stream"] = effect.input;
  }
  if (effect.only_value) tree["only_value"] = *effect.only_value;
}

}  // namespace parallax
