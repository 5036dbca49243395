// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/joint_pattern.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>

#include "modules/pixel.hpp"
#include "platform/cosim/bit_permutation.hpp"
#include "platform/cosim/pattern_evidence.hpp"

namespace parallax {
namespace {

constexpr std::int64_t kLatest = 8;     // tokens
constexpr std::int64_t kWidest = 16;    // px, of a rim
constexpr std::size_t kMostScaled = 4;  // bits
constexpr std::uint64_t kFewOfAll = 100, kFewOfDiffering = 10;
constexpr std::uint64_t kColumns = 512;  // tokens that the order of bits is looked for in

std::uint64_t ones_of(std::size_t bits) {
  return bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
}

class JointSearch {
 public:
  JointSearch(const TokenComparison& comparison, const TokenWords& expected, const TokenWords& got)
      : comparison_(comparison),
        shape_(comparison.stream->shape),
        fields_(shape_.format.all()),
        expected_(expected),
        got_(got),
        is_number_(fields_.front().name.rfind("code", 0) != 0) {
    take_samples();
  }

  std::vector<DifferencePattern> find() const {
    if (samples_.size() < kLeastMoved) return {};
    for (const Rule& rule : rules()) {
      for (const std::int64_t late : delays()) {
        if (late == 0 && rule.name.empty()) continue;
        if (const auto left = holds(rule, late)) return told(rule, late, *left);
      }
    }
    for (const std::int64_t late : delays()) {
      const auto order = find_bit_permutation(expected_, got_, late, inside_);
      if (!order) continue;
      const Rule rule{"bit_order", text(*order), [this, &order](std::uint64_t from, std::uint64_t at) {
                        return is_permuted(*order, expected_, from, got_, at);
                      }};
      if (const auto left = holds(rule, late)) return told(rule, late, *left);
    }
    return {};
  }

 private:
  // What a token is of a model's.
  struct Rule {
    std::string name, text;
    std::function<bool(std::uint64_t from, std::uint64_t at)> matches;
  };

  using OfValue = std::function<std::uint64_t(std::uint64_t value)>;
  Rule of_values(const std::string& name, const std::string& what, const OfValue& other) const {
    return {name, what, [this, other](std::uint64_t from, std::uint64_t at) {
              return std::all_of(fields_.begin(), fields_.end(), [&](const TokenField& field) {
                const std::uint64_t value = expected_.raw(from, field);
                return !got_.unknown(at, field) &&
                       got_.raw(at, field) ==
                           (is_none(value, field) ? value : other(value) & ones_of(field.width));
              });
            }};
  }

  // Of disparities, what is none stays so.
  static bool is_none(std::uint64_t value, const TokenField& field) {
    return value == kInvalidDisparity && field.name.rfind("disparity", 0) == 0;
  }

  // Pieces of so many bits in reverse order.
  Rule reversed(const std::string& name, const std::string& what, std::size_t piece) const {
    return {name, what, [this, piece](std::uint64_t from, std::uint64_t at) {
              const std::size_t width = expected_.width();
              for (std::size_t low = 0; low < width; low += piece) {
                if (expected_.raw(from, {"", low, piece}) != got_.raw(at, {"", width - piece - low, piece}))
                  return false;
              }
              return !got_.unknown(at);
            }};
  }

  std::vector<Rule> rules() const {
    std::vector<Rule> all{
        {"", "", [this](std::uint64_t from, std::uint64_t at) { return got_.same(at, expected_, from); }},
        of_values("inverted", "all bits are inverted", [](std::uint64_t value) { return ~value; })};
    const std::size_t width = expected_.width(), field = fields_.front().width;
    if (width > 1) all.push_back(reversed("bit_order", "the bits are in the other order", 1));
    if (width % 8 == 0 && width > 8)
      all.push_back(reversed("byte_order", "the bytes are in the other order", 8));
    if (fields_.size() > 1 && field <= 64 && width == field * fields_.size())
      all.push_back(reversed("field_order", "the values of a token are in the other order", field));
    if (!is_number_) return all;
    all.push_back(of_values("constant_offset", "all values are 1 too high",
                            [](std::uint64_t value) { return value + 1; }));
    all.push_back(of_values("constant_offset", "all values are 1 too low",
                            [](std::uint64_t value) { return value - 1; }));
    for (std::size_t bits = 1; bits <= kMostScaled && bits < field; ++bits) {
      all.push_back(of_values("scaled", fmt::format("all values are divided by {}", 1u << bits),
                              [bits](std::uint64_t value) { return value >> bits; }));
      all.push_back(of_values("scaled", fmt::format("all values are multiplied by {}", 1u << bits),
                              [bits](std::uint64_t value) { return value << bits; }));
    }
    return all;
  }

  std::vector<std::int64_t> delays() const {
    std::vector<std::int64_t> all{0};
    for (std::int64_t late = 1; late <= kLatest; ++late) all.insert(all.end(), {late, -late});
    if (const auto row = static_cast<std::int64_t>(shape_.row_tokens); row > kLatest)
      all.insert(all.end(), {row, -row});
    return all;
  }

  std::int64_t widest() const {
    return std::min<std::int64_t>(
        {kWidest, comparison_.manifest->tile_width / 4, comparison_.manifest->height / 4});
  }

  // Number of the ring of pixels, from the border, that a token lies in.
  std::int64_t ring(std::uint64_t token) const {
    if (shape_.row_tokens == 0) return INT64_MAX;
    const std::uint64_t in_tile = token % comparison_.manifest->pass_tokens(*comparison_.stream);
    const auto x = static_cast<std::int64_t>(in_tile % shape_.row_tokens / shape_.tokens_per_pixel *
                                             shape_.pixels_per_token);
    const auto y = static_cast<std::int64_t>(in_tile / shape_.row_tokens);
    const auto last = x + static_cast<std::int64_t>(shape_.pixels_per_token) - 1;
    return std::min(
        {x, comparison_.manifest->tile_width - 1 - last, y, comparison_.manifest->height - 1 - y});
  }

  // All over the stream: of those that differ, and of those no rim has.
  void take_samples() {
    const std::uint64_t every = std::max<std::uint64_t>(comparison_.different_tokens / kSamples, 1);
    const std::uint64_t apart = std::max<std::uint64_t>(comparison_.compared_tokens / (2 * kColumns), 1);
    std::uint64_t differing = 0;
    for (std::uint64_t i = 0; i < comparison_.compared_tokens; ++i) {
      if (i % apart == 0 && ring(i) >= widest()) inside_.push_back(i);
      if (!got_.same(i, expected_, i) && differing++ % every == 0) samples_.push_back(i);
    }
  }

  std::uint64_t tokens_in(std::int64_t rim) const {
    std::uint64_t tokens = 0;
    for (std::uint64_t i = 0; i < comparison_.compared_tokens; ++i) tokens += ring(i) < rim ? 1 : 0;
    return tokens;
  }

  // What a rule does not explain.
  struct Left {
    std::uint64_t tokens = 0, first = 0;
    std::int64_t rim = 0;  // px that all of them lie in
  };

  std::optional<Left> holds(const Rule& rule, std::int64_t late) const {
    const auto source = [late](std::uint64_t i) { return static_cast<std::int64_t>(i) - late; };
    const auto matches = [&](std::uint64_t i) {
      return source(i) < 0 || source(i) >= static_cast<std::int64_t>(expected_.size()) ||
             rule.matches(static_cast<std::uint64_t>(source(i)), i);
    };
    const std::size_t most = samples_.size() / 2;
    std::size_t missed = 0;
    for (const std::uint64_t i : samples_) {
      if (!matches(i) && ++missed > most) return std::nullopt;
    }
    Left left;
    std::uint64_t inside = 0, explained = 0;
    const std::int64_t rim = widest();
    const std::uint64_t few = comparison_.compared_tokens / kFewOfAll;
    for (std::uint64_t i = 0; i < comparison_.compared_tokens; ++i) {
      const bool is_inside = ring(i) >= rim;
      if (matches(i)) {
        explained += is_inside && !got_.same(i, expected_, i) ? 1 : 0;
        continue;
      }
      if (left.tokens++ == 0) left.first = i;
      inside += is_inside ? 1 : 0;
      if (inside > few) return std::nullopt;
      left.rim = std::max(left.rim, ring(i) == INT64_MAX ? ring(i) : ring(i) + 1);
    }
    if (explained < kLeastMoved) return std::nullopt;
    const bool are_few = left.tokens < few && kFewOfDiffering * left.tokens < comparison_.different_tokens;
    if (inside > 0 || (are_few && 2 * left.tokens < tokens_in(left.rim))) left.rim = 0;
    return inside == 0 || are_few ? std::optional(left) : std::nullopt;
  }

  DifferencePattern delayed(std::int64_t late) const {
    const char* const way = late > 0 ? "late" : "early";
    const auto tokens = static_cast<std::uint64_t>(std::abs(late));
    if (tokens == shape_.row_tokens) return {fmt::format("one_row_{}", way), fmt::format("one row {}", way)};
    if (shape_.row_tokens > 0 && tokens == shape_.tokens_per_pixel)
      return {fmt::format("one_column_{}", way), fmt::format("one column {}", way)};
    return {"constant_latency",
            fmt::format("all tokens are {} {} {}", tokens, tokens == 1 ? "token" : "tokens", way)};
  }

  std::vector<DifferencePattern> told(const Rule& rule, std::int64_t late, const Left& left) const {
    std::vector<DifferencePattern> all;
    if (!rule.name.empty()) all.push_back({rule.name, rule.text});
    if (late != 0) all.push_back(delayed(late));
    if (left.rim > 0) {
      all.back().text += fmt::format(", but for the rim of {} px", left.rim);
    } else if (left.tokens > 0) {
      const ValuePlace place = comparison_.manifest->place(*comparison_.stream, left.first, 0);
      all.back().text +=
          fmt::format(", but for {}, {} token {} (frame {}{})",
                      left.tokens == 1 ? std::string("one token") : fmt::format("{} tokens", left.tokens),
                      left.tokens == 1 ? "which is" : "the first one", left.first, place.frame,
                      place.row < 0 ? "" : fmt::format(", row {}, column {}", place.row, place.column));
    }
    return all;
  }

  const TokenComparison& comparison_;
  const TokenShape& shape_;
  const std::vector<TokenField>& fields_;
  const TokenWords& expected_;
  const TokenWords& got_;
  const bool is_number_;  // in which bits have values
  std::vector<std::uint64_t> samples_, inside_;
};

}  // namespace

std::vector<DifferencePattern> find_joint_patterns(const TokenComparison& comparison,
                                                   const TokenWords& expected, const TokenWords& got) {
  if (comparison.different_tokens < kLeastMoved) return {};
  return JointSearch(comparison, expected, got).find();
}

}  // namespace parallax
