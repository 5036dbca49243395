// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/value_mapping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>

#include "platform/cosim/pattern_evidence.hpp"

namespace parallax {
namespace {

// So many bits a comparison must have set, and cleared, to be the other way round.
constexpr std::uint64_t kLeastTurned = 8;

std::uint64_t mask(std::size_t bits) {
  return bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
}

std::uint64_t reversed_bits(std::uint64_t value, std::size_t width) {
  std::uint64_t out = 0;
  for (std::size_t i = 0; i < width; ++i) out |= (value >> i & 1u) << (width - 1 - i);
  return out;
}

std::uint64_t reversed_bytes(std::uint64_t value, std::size_t width) {
  std::uint64_t out = 0;
  for (std::size_t i = 0; i < width; i += 8) out |= (value >> i & 0xFFu) << (width - 8 - i);
  return out;
}

std::uint64_t ones(std::uint64_t bits) {
  std::uint64_t number = 0;
  for (; bits != 0; bits &= bits - 1) ++number;
  return number;
}

class MappingSearch {
 public:
  MappingSearch(const TokenComparison& comparison, const TokenWords& expected, const TokenWords& got,
                const std::vector<std::uint64_t>& differing)
      : comparison_(comparison),
        fields_(comparison.stream->shape.format.all()),
        expected_(expected),
        got_(got),
        differing_(differing),
        tokens_(comparison.compared_tokens) {}

  std::optional<DifferencePattern> find() {
    find_values();
    return found_;
  }

 private:
  void add(const std::string& name, const std::string& text) { found_ = DifferencePattern{name, text}; }

  template <class Matches>
  bool all_tokens(const Matches& matches) const {
    for (std::uint64_t i = 0; i < tokens_; ++i) {
      if (!matches(i)) return false;
    }
    return true;
  }

  // Whether each value that is known is what `rule` says of the model's; of those that are masked, or not.
  using Rule = std::function<bool(std::uint64_t expected, std::uint64_t got, std::size_t width)>;
  enum class Masked { kToo, kNot };
  bool follows(const Rule& rule, Masked masked = Masked::kToo) const {
    const auto matches = [&](std::uint64_t token) {
      if (masked == Masked::kNot && is_masked(token)) return true;
      return std::all_of(fields_.begin(), fields_.end(), [&](const TokenField& field) {
        return !got_.unknown(token, field) &&
               rule(expected_.raw(token, field), got_.raw(token, field), field.width);
      });
    };
    return std::all_of(differing_.begin(), differing_.end(), matches) && all_tokens(matches);
  }

  // Whether a token is equal to the model's, which is as its first one: so a rim that is masked begins.
  bool is_masked(std::uint64_t token) const {
    return got_.same(token, expected_, token) && expected_.same(token, expected_, 0);
  }

  // The same of a rule that says all of enough other tokens.
  bool add_if_follows(const Rule& rule, const std::string& name, const std::string& text) {
    const bool with_masked = follows(rule);
    if (!with_masked && (comparison_.different_tokens < kLeastMoved || !follows(rule, Masked::kNot)))
      return false;
    add(name, text + (with_masked ? "" : ", but for what is masked"));
    return true;
  }

  bool words_reversed(std::size_t piece) const {
    const std::size_t width = expected_.width();
    if (width % piece != 0 || width == piece) return false;
    const auto matches = [&](std::uint64_t token) {
      if (got_.unknown(token)) return false;
      for (std::size_t low = 0; low < width; low += piece) {
        if (expected_.raw(token, {"", low, piece}) != got_.raw(token, {"", width - piece - low, piece}))
          return false;
      }
      return true;
    };
    return std::all_of(differing_.begin(), differing_.end(), matches) && all_tokens(matches);
  }

  void find_values() {
    const bool whole_bytes = std::all_of(fields_.begin(), fields_.end(),
                                         [](const TokenField& field) { return field.width % 8 == 0; });
    const bool alike = std::all_of(fields_.begin(), fields_.end(), [this](const TokenField& field) {
      return field.width == fields_.front().width;
    });
    if (add_if_follows([](auto e, auto g, auto width) { return g == (~e & mask(width)); }, "inverted",
                       "all bits are inverted"))
      return;
    if (follows([](auto e, auto g, auto width) { return g == reversed_bits(e, width); }) ||
        words_reversed(1)) {
      add("bit_order", "the bits are in the other order");
    } else if ((whole_bytes &&
                follows([](auto e, auto g, auto width) { return g == reversed_bytes(e, width); })) ||
               words_reversed(8)) {
      add("byte_order", "the bytes are in the other order");
    } else if (alike && fields_.size() > 1 && words_reversed(fields_.front().width)) {
      add("field_order", "the fields of a token are in the other order");
    } else {
      find_arithmetic();
    }
  }

  void find_arithmetic() {
    const std::uint64_t first = differing_.front();
    const std::size_t index = comparison_.first->field;
    const std::size_t width = fields_[index].width;
    const std::uint64_t moved =
        (got_.raw(first, fields_[index]) - expected_.raw(first, fields_[index])) & mask(width);
    std::uint64_t largest = 0;
    std::uint64_t changed = 0, set = 0, cleared = 0;  // bits
    for (std::uint64_t token = 0; token < tokens_; ++token) {
      for (const TokenField& field : fields_) {
        largest = std::max(largest, got_.raw(token, field));
        const std::uint64_t right = expected_.raw(token, field), wrong = got_.raw(token, field);
        changed |= right ^ wrong;
        set += ones(wrong & ~right);
        cleared += ones(right & ~wrong);
      }
    }
    const bool is_turned = width > 2 && set >= kLeastTurned && cleared >= kLeastTurned;
    std::size_t bits = 0;
    while (bits < 64 && largest >> bits != 0) ++bits;
    if (follows([&](auto e, auto g, auto w) { return g == ((e + moved) & mask(w)); })) {
      const bool down = moved > mask(width) / 2;
      add("constant_offset", fmt::format("all values are {} too {}", down ? mask(width) - moved + 1 : moved,
                                         down ? "low" : "high"));
    } else if (bits < width && follows([&](auto e, auto g, auto) { return g == (e & mask(bits)); })) {
      add("top_bits_lost", fmt::format("only the lowest {} bits of each value are there", bits));
    } else if (follows([&](auto e, auto g, auto) { return g == std::min(e, largest); })) {
      add("saturated", fmt::format("values above {} are cut to it", largest));
    } else if (is_turned && find_turned()) {
      return;
    } else if ((changed & (changed - 1)) == 0) {
      std::size_t bit = 0;
      while (changed >> bit != 1) ++bit;
      add("one_bit", fmt::format("only bit {} of the values differs", bit));
    }
  }

  bool find_turned() {
    const std::string turned = "inverted_comparison", text = "the comparison is the other way round";
    return add_if_follows([](auto e, auto g, auto) { return (e & g) == 0; }, turned,
                          "no bit is 1 in both: " + text) ||
           add_if_follows([](auto e, auto g, auto w) { return (e | g) == mask(w); }, turned,
                          "no bit is 0 in both: " + text);
  }

  const TokenComparison& comparison_;
  const std::vector<TokenField>& fields_;
  const TokenWords& expected_;
  const TokenWords& got_;
  const std::vector<std::uint64_t>& differing_;
  const std::uint64_t tokens_;  // that both have
  std::optional<DifferencePattern> found_;
};

}  // namespace

std::optional<DifferencePattern> find_value_mapping(const TokenComparison& comparison,
                                                    const TokenWords& expected, const TokenWords& got,
                                                    const std::vector<std::uint64_t>& differing) {
  return MappingSearch(comparison, expected, got, differing).find();
}

}  // namespace parallax
