// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/token_shift.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>

namespace parallax {
namespace {

constexpr std::uint64_t kLeastBetween = 16;  // tokens that agree between two that are lost
constexpr int kWidestReach = 16;             // px; of a window of 33 x 33
constexpr std::int64_t kFarthest = 4;        // px that it is looked for

std::string place_text(const TokenComparison& comparison, std::uint64_t token) {
  const ValuePlace place = comparison.manifest->place(*comparison.stream, token, 0);
  if (place.row < 0) return fmt::format("token {} (frame {})", token, place.frame);
  return fmt::format("token {} (frame {}, row {}, column {})", token, place.frame, place.row, place.column);
}

class ShiftSearch {
 public:
  ShiftSearch(const TokenComparison& comparison, const TokenWords& expected, const TokenWords& got,
              const std::vector<std::uint64_t>& differing)
      : comparison_(comparison),
        shape_(comparison.stream->shape),
        expected_(expected),
        got_(got),
        differing_(differing) {}

  std::vector<DifferencePattern> find() {
    find_lost();
    if (found_.empty()) find_delay();
    if (found_.empty()) find_lost_here_and_there();
    if (found_.empty()) find_moved_inside();
    return found_;
  }

 private:
  void add(const std::string& name, const std::string& text) { found_.push_back({name, text}); }
  std::string place_of(std::uint64_t token) const { return place_text(comparison_, token); }

  // Whether got[i] is expected[i - late] for all i from `from` on for which both are there; late may be < 0.
  bool shifted(std::int64_t late, std::uint64_t from) const {
    const auto source = [late](std::uint64_t i) { return static_cast<std::int64_t>(i) - late; };
    const auto matches = [&](std::uint64_t i) {
      const std::int64_t at = source(i);
      return at < 0 || at >= static_cast<std::int64_t>(expected_.size()) ||
             got_.same(i, expected_, static_cast<std::uint64_t>(at));
    };
    std::size_t explained = 0;
    for (const std::uint64_t i : differing_) {
      if (i < from) continue;
      if (!matches(i)) return false;
      if (source(i) >= 0 && source(i) < static_cast<std::int64_t>(expected_.size())) ++explained;
    }
    if (explained < kLeastExplained) return false;
    for (std::uint64_t i = from; i < got_.size(); ++i) {
      if (!matches(i)) return false;
    }
    return true;
  }

  void find_lost() {
    const std::uint64_t at = comparison_.first->token;
    const auto difference = static_cast<std::int64_t>(comparison_.got_tokens) -
                            static_cast<std::int64_t>(comparison_.expected_tokens);
    const std::int64_t lost = difference < 0 ? -difference : 1;
    const std::int64_t extra = difference > 0 ? difference : 1;
    if (difference <= 0 && (at > 0 || difference < 0) && shifted(-lost, at)) {
      if (lost == 1) {
        add("token_lost", fmt::format("{} is lost, all others are there", place_of(at)));
      } else {
        add("tokens_lost",
            fmt::format("{} tokens are lost from {} on, all others are there", lost, place_of(at)));
      }
    } else if (difference >= 0 && at > 0 && shifted(extra, at + static_cast<std::uint64_t>(extra))) {
      const bool twice = extra == 1 && got_.same(at, expected_, at - 1);
      add(twice ? "token_doubled" : "tokens_inserted",
          fmt::format("{} before {}, all others are there",
                      twice ? "a token comes twice" : fmt::format("{} too many", extra), place_of(at)));
    }
  }

  // Tokens that are lost, or that come in addition, one here and one there: found by going through both and
  // leaving one out where the next ones then agree. Not both: where many are alike, as in a flat image, one
  // that has another value would be one too many, and lost at the flat part's end.
  void find_lost_here_and_there() {
    std::uint64_t lost = 0, inserted = 0, at = 0, from = 0;
    std::optional<std::uint64_t> first;
    while (at < got_.size() && from < expected_.size()) {
      if (got_.same(at, expected_, from)) {
        ++at;
        ++from;
        continue;
      }
      if (lost + inserted > got_.size() / kLeastBetween) return;
      if (!first) first = from;
      if (agree(at, from + 1)) {
        ++lost;
        ++from;
      } else if (agree(at + 1, from)) {
        ++inserted;
        ++at;
      } else {
        return;
      }
    }
    if (lost > 0 && inserted > 0) return;
    lost += expected_.size() - from;
    inserted += got_.size() - at;
    if (!first || lost + inserted < kLeastExplained) return;
    const bool few = lost >= inserted;
    add(few ? "tokens_lost" : "tokens_inserted",
        fmt::format("{} tokens are {}, the first one {}{}, all others are there", few ? lost : inserted,
                    few ? "lost" : "too many", few ? "" : "before ", place_of(*first)));
  }

  // Whether the next tokens are the same.
  bool agree(std::uint64_t at, std::uint64_t from) const {
    for (std::uint64_t i = 0; i < kLeastBetween; ++i) {
      if (at + i >= got_.size() || from + i >= expected_.size()) return i > 0;
      if (!got_.same(at + i, expected_, from + i)) return false;
    }
    return true;
  }

  void find_delay() {
    const std::uint64_t row = shape_.row_tokens;
    const std::uint64_t pixel = shape_.tokens_per_pixel;
    const std::uint64_t most = std::min<std::uint64_t>(comparison_.compared_tokens / 2, 4 * row + 64);
    const auto name = [&](std::uint64_t late, bool early) {
      const char* const way = early ? "early" : "late";
      const std::uint64_t rows = row > 0 && late % row == 0 ? late / row : 0;
      if (rows == 1) {
        add(fmt::format("one_row_{}", way), fmt::format("one row {}", way));
      } else if (row > 0 && late == pixel) {
        add(fmt::format("one_column_{}", way), fmt::format("one column {}", way));
      }
      add("constant_latency",
          fmt::format("all tokens are {} {} {}", late, late == 1 ? "token" : "tokens", way));
    };
    for (std::uint64_t late = 1; late <= most; ++late) {
      if (shifted(static_cast<std::int64_t>(late), late)) return name(late, false);
      if (shifted(-static_cast<std::int64_t>(late), 0)) return name(late, true);
    }
    if (row == 0) return;
    for (const std::int64_t way : {1, -1}) {
      const auto columns = way * static_cast<std::int64_t>(pixel);
      if (shifted_in_rows(columns)) {
        return add(way > 0 ? "one_column_late" : "one_column_early",
                   way > 0 ? "one column late, in each row" : "one column early, in each row");
      }
    }
  }

  bool shifted_in_rows(std::int64_t late) const {
    const auto row = static_cast<std::int64_t>(shape_.row_tokens);
    const auto matches = [&](std::uint64_t i) {
      const std::int64_t in_row = static_cast<std::int64_t>(i) % row - late;
      return in_row < 0 || in_row >= row || got_.same(i, expected_, i - static_cast<std::uint64_t>(late));
    };
    if (!std::all_of(differing_.begin(), differing_.end(), matches)) return false;
    for (std::uint64_t i = 0; i < comparison_.compared_tokens; ++i) {
      if (!matches(i)) return false;
    }
    return true;
  }

  // A window that is not where it should be: at the border of the image it sees something else, inside it is
  // the model's of another place.
  void find_moved_inside() {
    const VectorManifest& manifest = *comparison_.manifest;
    if (shape_.row_tokens == 0 || shape_.pixels_per_token > 1 || rim(manifest.tile_width) < kFarthest ||
        rim(manifest.height) < kFarthest)
      return;
    for (std::int64_t distance = 1; distance <= kFarthest; ++distance) {
      for (std::int64_t rows = -distance; rows <= distance; ++rows) {
        const std::int64_t rest = distance - std::abs(rows);
        for (const std::int64_t columns : {rest, -rest}) {
          if (moved_inside(columns, rows)) return add_moved(columns, rows);
        }
      }
    }
  }

  void add_moved(std::int64_t columns, std::int64_t rows) {
    const auto text = [](std::int64_t number, const char* what) {
      return number == 0 ? std::string()
                         : fmt::format("{} {}{} {}", std::abs(number), what, std::abs(number) == 1 ? "" : "s",
                                       number > 0 ? "late" : "early");
    };
    const std::string in_row = text(columns, "column");
    const std::string down = text(rows, "row");
    const std::string both = in_row + (in_row.empty() || down.empty() ? "" : " and ") + down;
    const bool one = std::abs(columns) + std::abs(rows) == 1;
    add(one ? fmt::format("one_{}_{}", columns != 0 ? "column" : "row", columns + rows > 0 ? "late" : "early")
            : "moved",
        both + ", but for the rim");
  }

  // Whether every token inside is the model's of so many columns and rows before.
  bool moved_inside(std::int64_t columns, std::int64_t rows) const {
    const auto back = columns * static_cast<std::int64_t>(shape_.tokens_per_pixel) +
                      rows * static_cast<std::int64_t>(shape_.row_tokens);
    std::size_t explained = 0;
    for (const std::uint64_t i : differing_) {
      if (!inside(i)) continue;
      if (!got_.same(i, expected_, i - static_cast<std::uint64_t>(back))) return false;
      ++explained;
    }
    if (explained < kLeastExplained) return false;
    for (std::uint64_t i = 0; i < comparison_.compared_tokens; ++i) {
      if (inside(i) && !got_.same(i, expected_, i - static_cast<std::uint64_t>(back))) return false;
    }
    return true;
  }

  // Columns or rows at the border that a window may see.
  static int rim(int size) { return std::min(kWidestReach, size / 4); }

  bool inside(std::uint64_t token) const {
    const VectorManifest& manifest = *comparison_.manifest;
    const ValuePlace place = manifest.place(*comparison_.stream, token, 0);
    const std::int64_t x = place.column - manifest.tile_begins[static_cast<std::size_t>(place.tile)];
    const int columns = rim(manifest.tile_width);
    const int rows = rim(manifest.height);
    return x >= columns && x < manifest.tile_width - columns && place.row >= rows &&
           place.row < manifest.height - rows;
  }

  const TokenComparison& comparison_;
  const TokenShape& shape_;
  const TokenWords& expected_;
  const TokenWords& got_;
  const std::vector<std::uint64_t>& differing_;
  std::vector<DifferencePattern> found_;
};

}  // namespace

std::vector<DifferencePattern> find_end(const TokenComparison& comparison) {
  if (comparison.different_tokens > 0) return {};
  if (comparison.got_tokens == 0) return {{"truncated", "no token came out"}};
  if (comparison.got_tokens < comparison.expected_tokens) {
    return {{"truncated", fmt::format("it ends before {}, all before that is equal",
                                      place_text(comparison, comparison.compared_tokens))}};
  }
  return {{"surplus", "more tokens at the end, all before them are equal"}};
}

std::vector<DifferencePattern> find_shift(const TokenComparison& comparison, const TokenWords& expected,
                                          const TokenWords& got,
                                          const std::vector<std::uint64_t>& differing) {
  return ShiftSearch(comparison, expected, got, differing).find();
}

}  // namespace parallax
