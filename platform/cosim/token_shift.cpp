// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/token_shift.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "platform/cosim/pattern_evidence.hpp"
#include "platform/cosim/stream_end.hpp"

namespace parallax {
namespace {

constexpr std::int64_t kWidestReach = 16;  // px; of a window of 33 x 33
constexpr std::int64_t kFarthest = 8;      // px that it is looked for, in each direction

class ShiftSearch {
 public:
  ShiftSearch(const TokenComparison& comparison, const TokenWords& expected, const TokenWords& got)
      : comparison_(comparison), shape_(comparison.stream->shape), expected_(expected), got_(got) {}

  std::vector<DifferencePattern> delay(const std::vector<std::uint64_t>& differing) {
    if (differing.size() >= kLeastMoved) find_delay(differing);
    return found_;
  }

  std::vector<DifferencePattern> moved() {
    if (comparison_.different_tokens >= kLeastMoved) find_moved();
    return found_;
  }

 private:
  void add(const std::string& name, const std::string& text) { found_.push_back({name, text}); }

  // Whether got[i] is expected[i - late] for all i from `from` on for which both are there; late may be < 0.
  // `anew`: where both are of one frame.
  bool shifted(std::int64_t late, std::uint64_t from, const std::vector<std::uint64_t>& differing,
               bool anew) const {
    const auto frame = static_cast<std::int64_t>(comparison_.stream->frame_tokens);
    const auto source = [late](std::uint64_t i) { return static_cast<std::int64_t>(i) - late; };
    const auto is_there = [&](std::uint64_t i) {
      return source(i) >= 0 && source(i) < static_cast<std::int64_t>(expected_.size()) &&
             (!anew || source(i) / frame == static_cast<std::int64_t>(i) / frame);
    };
    const auto matches = [&](std::uint64_t i) {
      return !is_there(i) || got_.same(i, expected_, static_cast<std::uint64_t>(source(i)));
    };
    std::size_t explained = 0;
    for (const std::uint64_t i : differing) {
      if (i < from) continue;
      if (!matches(i)) return false;
      explained += is_there(i) ? 1 : 0;
    }
    if (explained < kLeastMoved) return false;
    for (std::uint64_t i = from; i < got_.size(); ++i) {
      if (!matches(i)) return false;
    }
    return true;
  }

  void find_delay(const std::vector<std::uint64_t>& differing) {
    const std::uint64_t row = shape_.row_tokens;
    const std::uint64_t pixel = shape_.tokens_per_pixel;
    const std::uint64_t most = std::min<std::uint64_t>(comparison_.compared_tokens / 2, 4 * row + 64);
    const auto name = [&](std::uint64_t late, bool early, bool anew) {
      const char* const way = early ? "early" : "late";
      const std::uint64_t rows = row > 0 && late % row == 0 ? late / row : 0;
      if (rows == 1) {
        add(fmt::format("one_row_{}", way), fmt::format("one row {}", way));
      } else if (row > 0 && late == pixel) {
        add(fmt::format("one_column_{}", way), fmt::format("one column {}", way));
      }
      // Before that, in a masked border, the model's tokens are alike.
      const std::uint64_t first = comparison_.first->token;
      add("constant_latency",
          fmt::format("all tokens are {} {} {}{}{}", late, late == 1 ? "token" : "tokens", way,
                      anew ? ", in each frame anew" : "",
                      first > late ? ", as shows from " + place_text(comparison_, first) + " on" : ""));
    };
    for (const bool anew : {false, true}) {
      if (anew && (comparison_.manifest->frames < 2 || comparison_.stream->frame_tokens == 0)) continue;
      for (std::uint64_t late = 1; late <= most; ++late) {
        if (shifted(static_cast<std::int64_t>(late), late, differing, anew)) return name(late, false, anew);
        if (shifted(-static_cast<std::int64_t>(late), 0, differing, anew)) return name(late, true, anew);
      }
    }
    if (row == 0) return;
    for (const std::int64_t way : {1, -1}) {
      const auto columns = way * static_cast<std::int64_t>(pixel);
      if (shifted_in_rows(columns, differing)) {
        return add(way > 0 ? "one_column_late" : "one_column_early",
                   way > 0 ? "one column late, in each row" : "one column early, in each row");
      }
    }
  }

  bool shifted_in_rows(std::int64_t late, const std::vector<std::uint64_t>& differing) const {
    const auto row = static_cast<std::int64_t>(shape_.row_tokens);
    const auto matches = [&](std::uint64_t i) {
      const std::int64_t in_row = static_cast<std::int64_t>(i) % row - late;
      return in_row < 0 || in_row >= row || got_.same(i, expected_, i - static_cast<std::uint64_t>(late));
    };
    if (!std::all_of(differing.begin(), differing.end(), matches)) return false;
    for (std::uint64_t i = 0; i < comparison_.compared_tokens; ++i) {
      if (!matches(i)) return false;
    }
    return true;
  }

  // A window that is not where it should be: at the border of the image it sees something else, inside it is
  // the model's of another place.
  void find_moved() {
    if (shape_.row_tokens == 0 || shape_.pixels_per_token > 1) return;
    const std::vector<std::uint64_t> samples = differing_inside();
    if (samples.size() < kLeastMoved) return;
    const std::int64_t most_columns = std::min(kFarthest, rim(comparison_.manifest->tile_width));
    const std::int64_t most_rows = std::min(kFarthest, rim(comparison_.manifest->height));
    for (std::int64_t distance = 1; distance <= most_columns + most_rows; ++distance) {
      for (std::int64_t rows = -std::min(distance, most_rows); rows <= std::min(distance, most_rows);
           ++rows) {
        const std::int64_t rest = distance - std::abs(rows);
        if (rest > most_columns) continue;
        for (const std::int64_t columns : {rest, -rest}) {
          if (is_moved(columns, rows, samples)) return add_moved(columns, rows);
        }
      }
    }
  }

  // The first of the tokens that differ though a window there sees no border.
  std::vector<std::uint64_t> differing_inside() const {
    std::vector<std::uint64_t> samples;
    for (std::uint64_t i = 0; i < comparison_.compared_tokens && samples.size() < kSamples; ++i) {
      if (!got_.same(i, expected_, i) && is_inside(i)) samples.push_back(i);
    }
    return samples;
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
        fmt::format("{}, but for the rim of {} px", both, rim_of_others(columns, rows)));
  }

  std::uint64_t from(std::uint64_t token, std::int64_t columns, std::int64_t rows) const {
    return token - static_cast<std::uint64_t>(columns * static_cast<std::int64_t>(shape_.tokens_per_pixel) +
                                              rows * static_cast<std::int64_t>(shape_.row_tokens));
  }

  // Whether every token inside is the model's of so many columns and rows before.
  bool is_moved(std::int64_t columns, std::int64_t rows, const std::vector<std::uint64_t>& samples) const {
    const auto matches = [&](std::uint64_t i) { return got_.same(i, expected_, from(i, columns, rows)); };
    if (!std::all_of(samples.begin(), samples.end(), matches)) return false;
    for (std::uint64_t i = 0; i < comparison_.compared_tokens; ++i) {
      if (is_inside(i) && !matches(i)) return false;
    }
    return true;
  }

  // Width of the rim that has others than the moved ones, px.
  std::int64_t rim_of_others(std::int64_t columns, std::int64_t rows) const {
    std::int64_t width = 0;
    for (std::uint64_t i = 0; i < comparison_.compared_tokens; ++i) {
      const Place place = place_of(i);
      const std::int64_t x = place.x - columns, y = place.y - rows;
      const bool is_there =
          x >= 0 && x < comparison_.manifest->tile_width && y >= 0 && y < comparison_.manifest->height;
      const std::int64_t reach = distance_to_border(place) + 1;
      if (reach > width && (!is_there || !got_.same(i, expected_, from(i, columns, rows)))) width = reach;
    }
    return width;
  }

  // In its tile, in the order in which the tokens come.
  struct Place {
    std::int64_t x, y;
  };
  Place place_of(std::uint64_t token) const {
    const std::uint64_t in_tile = token % comparison_.manifest->pass_tokens(*comparison_.stream);
    return {static_cast<std::int64_t>(in_tile % shape_.row_tokens / shape_.tokens_per_pixel),
            static_cast<std::int64_t>(in_tile / shape_.row_tokens)};
  }
  std::int64_t distance_to_border(const Place& place) const {
    return std::min({place.x, comparison_.manifest->tile_width - 1 - place.x, place.y,
                     comparison_.manifest->height - 1 - place.y});
  }

  // Columns or rows at the border that a window may see.
  static std::int64_t rim(std::int64_t size) { return std::min(kWidestReach, size / 4); }

  bool is_inside(std::uint64_t token) const {
    const Place place = place_of(token);
    const std::int64_t width = comparison_.manifest->tile_width, height = comparison_.manifest->height;
    return place.x >= rim(width) && place.x < width - rim(width) && place.y >= rim(height) &&
           place.y < height - rim(height);
  }

  const TokenComparison& comparison_;
  const TokenShape& shape_;
  const TokenWords& expected_;
  const TokenWords& got_;
  std::vector<DifferencePattern> found_;
};

}  // namespace

std::vector<DifferencePattern> find_delay(const TokenComparison& comparison, const TokenWords& expected,
                                          const TokenWords& got,
                                          const std::vector<std::uint64_t>& differing) {
  return ShiftSearch(comparison, expected, got).delay(differing);
}

std::vector<DifferencePattern> find_moved(const TokenComparison& comparison, const TokenWords& expected,
                                          const TokenWords& got) {
  return ShiftSearch(comparison, expected, got).moved();
}

}  // namespace parallax
