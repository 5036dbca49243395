// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/frame_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "platform/cosim/pattern_evidence.hpp"

namespace parallax {
namespace {

class OrderSearch {
 public:
  OrderSearch(const TokenComparison& comparison, const TokenWords& expected, const TokenWords& got)
      : comparison_(comparison), shape_(comparison.stream->shape), expected_(expected), got_(got) {}

  std::optional<DifferencePattern> find() const {
    if (shape_.row_tokens > 0) {
      if (auto found = find_turned()) return found;
    }
    if (follows(Block{"token", 1, 0}, [](std::uint64_t j) { return j ^ 1u; }))
      return DifferencePattern{"pairs_swapped",
                               "the two tokens of each pair are exchanged: 1, 0, 3, 2 and so on"};
    if (auto found = find_row_order()) return found;
    for (const Block& block : blocks()) {
      if (auto found = find_blocks(block)) return found;
    }
    return std::nullopt;
  }

 private:
  // What comes or goes as one: a token, the tokens of a pixel, a row.
  struct Block {
    const char* name;
    std::uint64_t tokens;
    std::uint64_t in_line;  // of a row those of pixels, of an image those of rows; 0: no lines are known
  };

  std::vector<Block> blocks() const {
    const std::uint64_t row = shape_.row_tokens;
    const bool is_pixel = row > 0 && shape_.pixels_per_token == 1;
    std::vector<Block> all;
    if (is_pixel) all.push_back({"pixel", shape_.tokens_per_pixel, row / shape_.tokens_per_pixel});
    if (!is_pixel || shape_.tokens_per_pixel > 1) all.push_back({"token", 1, 0});
    if (row > 0) all.push_back({"row", row, comparison_.manifest->pass_tokens(*comparison_.stream) / row});
    return all;
  }

  // Whether the pixels of a token are those of another one, in this order or the other.
  bool same_pixels(std::uint64_t token, std::uint64_t other, bool mirrored) const {
    if (!mirrored || shape_.pixels_per_token == 1) return got_.same(token, expected_, other);
    if (got_.unknown(token)) return false;
    const std::vector<TokenField>& fields = shape_.format.all();
    const std::size_t of_pixel = fields.size() / shape_.pixels_per_token;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const std::size_t pixel = shape_.pixels_per_token - 1 - i / of_pixel;
      if (got_.raw(token, fields[i]) != expected_.raw(other, fields[pixel * of_pixel + i % of_pixel]))
        return false;
    }
    return true;
  }

  bool is_turned(bool in_row, bool down) const {
    const std::uint64_t tile = comparison_.manifest->pass_tokens(*comparison_.stream);
    const std::uint64_t row = shape_.row_tokens, unit = shape_.tokens_per_pixel;
    for (std::uint64_t i = 0; i < comparison_.compared_tokens; ++i) {
      const std::uint64_t in_tile = i % tile;
      std::uint64_t y = in_tile / row, x = in_tile % row / unit;
      if (in_row) x = row / unit - 1 - x;
      if (down) y = tile / row - 1 - y;
      if (!same_pixels(i, i - in_tile + y * row + x * unit + in_tile % unit, in_row)) return false;
    }
    return true;
  }

  std::optional<DifferencePattern> find_turned() const {
    if (is_turned(true, false))
      return DifferencePattern{"mirrored", "each row is mirrored: its last pixel comes first"};
    if (is_turned(false, true))
      return DifferencePattern{"upside_down", "the rows are upside down: the last one comes first"};
    if (is_turned(true, true))
      return DifferencePattern{"turned", "the image is turned by 180 degrees: its last pixel comes first"};
    return std::nullopt;
  }

  // Whether each frame has all rows of the model's, in another order.
  std::optional<DifferencePattern> find_row_order() const {
    const std::uint64_t row = shape_.row_tokens;
    if (row == 0 || got_.size() != expected_.size() || expected_.size() % row != 0) return std::nullopt;
    const std::uint64_t rows = comparison_.stream->frame_tokens / row;
    const auto same = [&](std::uint64_t mine, std::uint64_t others) {
      for (std::uint64_t i = 0; i < row; ++i) {
        if (!got_.same(mine * row + i, expected_, others * row + i)) return false;
      }
      return true;
    };
    std::vector<bool> taken(expected_.size() / row);
    for (std::uint64_t j = 0; j < taken.size(); ++j) taken[j] = same(j, j);
    std::uint64_t moved = 0, first = 0, source = 0;
    for (std::uint64_t j = 0; j < taken.size(); ++j) {
      if (same(j, j)) continue;
      // Of a row that differs, the nearest one in the frame.
      const std::uint64_t begin = j - j % rows, end = begin + rows;
      std::uint64_t found = end;
      for (std::uint64_t away = 1; away < rows && found == end; ++away) {
        if (j >= begin + away && !taken[j - away] && same(j, j - away)) found = j - away;
        if (found == end && j + away < end && !taken[j + away] && same(j, j + away)) found = j + away;
      }
      if (found == end) return std::nullopt;
      taken[found] = true;
      if (moved++ == 0) {
        first = j % rows;
        source = found % rows;
      }
    }
    return DifferencePattern{
        "row_order",
        fmt::format("{} rows are there in another order, the first of them as row {}, which is row {}", moved,
                    first, source)};
  }

  // Whether block j is the model's block source(j), as far as there is one.
  template <class Source>
  bool follows(const Block& block, const Source& source) const {
    std::uint64_t compared = 0;
    for (std::uint64_t i = 0; i < got_.size(); ++i) {
      const std::uint64_t from = source(i / block.tokens) * block.tokens + i % block.tokens;
      if (from >= expected_.size()) continue;
      if (!got_.same(i, expected_, from)) return false;
      ++compared;
    }
    return compared >= kLeastMoved;
  }

  std::optional<DifferencePattern> find_blocks(const Block& block) const {
    const auto tell = [&block](const char* name, const std::string& text) {
      return DifferencePattern{name, fmt::format(text, block.name)};
    };
    // More than there can be is something else behind it.
    const bool is_half = got_.size() <= (expected_.size() + block.tokens) / 2;
    if (is_half && follows(block, [](std::uint64_t j) { return 2 * j; }))
      return tell("every_second", "only every second {} is there, from the first one on");
    if (is_half && follows(block, [](std::uint64_t j) { return 2 * j + 1; }))
      return tell("every_second", "only every second {} is there, from the second one on");
    if (follows(block, [](std::uint64_t j) { return j / 2; }))
      return tell("each_twice", "each {} comes twice");
    if (const std::uint64_t line = block.in_line;
        line > 0 && follows(block, [line](std::uint64_t j) { return j - j % line + j % line / 2; }))
      return tell("each_twice", "each {0} comes twice, so that only the first half of all {0}s is there");
    if (follows(block, [](std::uint64_t j) { return j - j % 2; }))
      return tell("every_second_twice", "every second {0} is there twice, in the place of the {0} behind it");
    if (follows(block, [](std::uint64_t j) { return j | 1u; }))
      return tell("every_second_twice", "every second {0} is there twice, in the place of the {0} before it");
    return std::nullopt;
  }

  const TokenComparison& comparison_;
  const TokenShape& shape_;
  const TokenWords& expected_;
  const TokenWords& got_;
};

}  // namespace

std::optional<DifferencePattern> find_frame_order(const TokenComparison& comparison,
                                                  const TokenWords& expected, const TokenWords& got) {
  if (comparison.different_tokens < kLeastMoved) return std::nullopt;
  return OrderSearch(comparison, expected, got).find();
}

}  // namespace parallax
