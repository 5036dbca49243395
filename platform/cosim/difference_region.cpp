// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/difference_region.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>

#include "platform/cosim/pattern_evidence.hpp"

namespace parallax {
namespace {

constexpr std::int64_t kWidestRim = 16;  // px; 31 x 31 is the largest usual window

// The least and the greatest of some places.
struct Extent {
  std::int64_t least = INT64_MAX, most = INT64_MIN;
  void add(std::int64_t place) {
    least = std::min(least, place);
    most = std::max(most, place);
  }
  std::int64_t length() const { return most - least + 1; }
};

// Share of all rows, columns or frames but the first.
double all_but_one(std::int64_t number) { return 1 - 1 / static_cast<double>(number); }

class RegionSearch {
 public:
  RegionSearch(const TokenComparison& comparison, const TokenWords& expected, const TokenWords& got)
      : comparison_(comparison),
        manifest_(*comparison.manifest),
        stream_(*comparison.stream),
        fields_(stream_.shape.format.all()),
        expected_(expected),
        tokens_(comparison.compared_tokens) {
    for_each_difference(stream_, expected, got,
                        [this](std::uint64_t token, std::size_t field) { note_place(token, field); });
  }

  DifferenceRegions find() {
    find_regions();
    return found_;
  }

 private:
  void add(const std::string& name, const std::string& text) { found_.patterns.push_back({name, text}); }

  // Of millions of values most lie where the one before did.
  template <class T>
  static void note(std::set<T>& all, T& last, T value) {
    if (!all.empty() && value == last) return;
    last = value;
    all.insert(value);
  }

  void note_place(std::uint64_t token, std::size_t field) {
    const ValuePlace place = manifest_.place(stream_, token, field);
    note(frames_, last_frame_, place.frame);
    if (place.tile >= 0) note(tiles_, last_tile_, place.tile);
    note(groups_, last_group_, token % stream_.shape.tokens_per_pixel);
    if (place.row < 0) return;
    const std::int64_t x = place.column - manifest_.tile_begins[static_cast<std::size_t>(place.tile)];
    const std::int64_t right = manifest_.tile_width - 1 - x;
    const std::int64_t below = manifest_.height - 1 - place.row;
    rim_ = std::max(rim_, std::min({x, right, place.row, below}));
    left_ = std::max(left_, x);
    right_ = std::max(right_, right);
    top_ = std::max(top_, place.row);
    bottom_ = std::max(bottom_, below);
    left_least_ = std::min(left_least_, x);
    right_least_ = std::min(right_least_, right);
    top_least_ = std::min(top_least_, place.row);
    bottom_least_ = std::min(bottom_least_, below);
    note(columns_, last_column_, x);
    row_extent_.add(place.row);
    column_extent_.add(x);
    const bool is_turned = stream_.shape.order == ScanOrder::kTurned;
    const bool is_from_right = stream_.shape.order != ScanOrder::kRaster;
    in_second_row_ += (is_turned ? below : place.row) == 1 ? 1 : 0;
    in_second_column_ += (is_from_right ? right : x) == 1 ? 1 : 0;
  }

  // "the first 3 columns"
  static std::string border(const char* which, std::int64_t number, const char* what) {
    if (number == 1) return fmt::format("only the {} {} differs", which, what);
    return fmt::format("only the {} {} {}s differ", which, number, what);
  }

  void find_regions() {
    if (!comparison_.disparities.empty()) find_disparities();
    if (stream_.shape.row_tokens > 0 && comparison_.different_tokens >= kLeastExplained) find_image_regions();
    if (fields_.size() > 1 && comparison_.fields.size() == 1 && !is_one_disparity()) {
      add("one_field", fmt::format("only field {} differs", comparison_.fields.begin()->first));
    }
    // Of frames that did not come out nothing is known.
    const bool are_all_there = comparison_.compared_tokens >= comparison_.expected_tokens;
    if (manifest_.frames > 1 && are_all_there &&
        frames_.size() < static_cast<std::size_t>(manifest_.frames)) {
      if (frames_.count(0) == 0 && frames_.size() + 1 == static_cast<std::size_t>(manifest_.frames) &&
          is_no_chance(all_but_one(manifest_.frames)))
        add("frames_after_first",
            "the first frame is equal, all others differ: something is left over of it");
      if (frames_.size() == 1 && frames_.count(0) == 1 &&
          is_no_chance(1 / static_cast<double>(manifest_.frames)))
        add("only_first_frame", "only the first frame differs");
    }
    if (manifest_.tile_begins.size() > 1 && tiles_.size() == 1)
      add("one_tile", fmt::format("only tile {} differs", *tiles_.begin()));
  }

  // Rows of the image that came out, of any frame; those of a stream that is cut are fewer.
  std::int64_t rows_there() const {
    const std::uint64_t row = stream_.shape.row_tokens;
    return tokens_ >= stream_.frame_tokens
               ? manifest_.height
               : std::min<std::int64_t>(manifest_.height,
                                        static_cast<std::int64_t>((tokens_ + row - 1) / row));
  }

  // Whether differences lie all along a border of such a length: over half of it, or over as much as so few
  // may by chance. A blob near the border does not.
  bool is_all_along(const Extent& extent, std::int64_t length) const {
    return 2 * extent.length() >= length ||
           !is_no_chance(static_cast<double>(extent.length()) / static_cast<double>(length));
  }

  // Whether all differences lie in such a share of the image, or of the frames, though spread evenly so many
  // would not.
  bool is_no_chance(double share) const {
    const double pixels = quotient(comparison_.different_tokens, stream_.shape.tokens_per_pixel);
    return -std::log(share) * pixels >= kMissedByChance;
  }

  // Width of the rim in which nothing differs on any side, px; 0 also where none need differ there: so little
  // does elsewhere, or the rim is all the same, as if masked.
  std::int64_t equal_rim() const {
    const std::initializer_list<std::int64_t> sides = {left_least_, right_least_, top_least_, bottom_least_};
    if (std::max(sides) > kWidestRim) return 0;  // it lies in one part of the image
    const std::int64_t rim = std::min(sides);
    const std::int64_t width = manifest_.tile_width, height = manifest_.height;
    const std::int64_t inside = (width - 2 * rim) * (height - 2 * rim);
    if (!is_no_chance(static_cast<double>(inside) / static_cast<double>(width * height))) return 0;
    const std::uint64_t masked = expected_.raw(0, fields_.front());
    const auto is_in_rim = [&](const ValuePlace& place) {
      const std::int64_t x = place.column - manifest_.tile_begins[static_cast<std::size_t>(place.tile)];
      return std::min({x, width - 1 - x, place.row, height - 1 - place.row}) < rim;
    };
    for (std::uint64_t token = 0; token < tokens_; ++token) {
      for (std::size_t field = 0; field < fields_.size(); ++field) {
        if (expected_.raw(token, fields_[field]) != masked &&
            is_in_rim(manifest_.place(stream_, token, field)))
          return rim;
      }
    }
    return 0;
  }

  // Whether a row or a column of the model is all the same, as if masked: that it is equal says nothing.
  bool is_same(std::int64_t ValuePlace::*of, std::int64_t line) const {
    std::set<std::uint64_t> values;
    const std::uint64_t frame = std::min(tokens_, stream_.frame_tokens);
    for (std::uint64_t token = 0; token < frame && values.size() < 2; ++token) {
      for (std::size_t field = 0; field < fields_.size(); ++field) {
        if (manifest_.place(stream_, token, field).*of == line)
          values.insert(expected_.raw(token, fields_[field]));
      }
    }
    return values.size() < 2;
  }

  void find_image_regions() {
    const std::int64_t width = manifest_.tile_width;
    const std::int64_t height = rows_there();
    const bool is_whole = height == manifest_.height;
    if (!is_whole && stream_.shape.order == ScanOrder::kTurned) return;
    const auto is_small = [](std::int64_t reach, std::int64_t size) {
      return reach < kWidestRim && 4 * (reach + 1) <= size;
    };
    const std::size_t before = found_.patterns.size();
    // Most of them, or they are no border but lines near it.
    const auto is_border = [&](std::int64_t reach, std::int64_t size, std::size_t lines) {
      return is_small(reach, size) && 2 * static_cast<std::int64_t>(lines) > reach + 1;
    };
    const bool is_along_rows = is_all_along(column_extent_, width);
    const bool is_along_columns = is_all_along(row_extent_, height);
    const std::size_t rows = comparison_.rows.size(), columns = columns_.size();
    if (is_along_rows && is_border(top_, height, rows))
      add("only_first_rows", border("first", top_ + 1, "row"));
    if (is_along_rows && is_whole && is_border(bottom_, height, rows))
      add("only_last_rows", border("last", bottom_ + 1, "row"));
    if (is_along_columns && is_border(left_, width, columns))
      add("only_first_columns", border("first", left_ + 1, "column"));
    if (is_along_columns && is_border(right_, width, columns))
      add("only_last_columns", border("last", right_ + 1, "column"));
    if (found_.patterns.size() == before && rows == 1)
      add("one_row", fmt::format("only row {} differs", comparison_.rows.begin()->first));
    if (found_.patterns.size() == before && columns == 1)
      add("one_column", fmt::format("only column {} differs", *columns_.begin()));
    if (!is_whole) return;
    const std::int64_t within = (width - 2 * (rim_ + 1)) * (height - 2 * (rim_ + 1));
    // That all lie there by chance must be as rare as that none lies in a part of the image.
    const double share = 1 - static_cast<double>(within) / static_cast<double>(width * height);
    const bool is_all_around = std::max({left_least_, right_least_, top_least_, bottom_least_}) <= rim_;
    if (found_.patterns.size() == before && is_small(rim_, std::min(width, height)) && is_all_around &&
        share <= 0.5 && is_no_chance(share))
      add("only_rim", fmt::format("only the rim differs, {} px wide", rim_ + 1));
    if (const std::int64_t equal = equal_rim(); equal > 0 && is_small(equal - 1, std::min(width, height))) {
      add("all_but_rim",
          fmt::format("the rim is equal, {} px wide, what lies inside it differs: what comes from "
                      "all around a pixel",
                      equal));
      return;
    }
    found_.is_small = found_.patterns.size() > before;
    const ScanOrder order = stream_.shape.order;
    const std::int64_t first_row = order == ScanOrder::kTurned ? bottom_least_ : top_least_;
    const std::int64_t first_column = order == ScanOrder::kRaster ? left_least_ : right_least_;
    const auto tells = [&](std::int64_t ValuePlace::*of, std::int64_t line) { return !is_same(of, line); };
    if (first_row == 1 && is_no_chance(all_but_one(height)) &&
        tells(&ValuePlace::row, order == ScanOrder::kTurned ? height - 1 : 0) &&
        2 * rows >= static_cast<std::size_t>(height - 1) && height > 2 &&
        is_as_others(in_second_row_, rows)) {
      add("rows_after_first",
          order == ScanOrder::kTurned
              ? "the last row is equal, those above it differ: what comes from the row below"
              : "the first row is equal, those after it differ: what comes from the row above");
    }
    if (first_column == 1 && is_no_chance(all_but_one(width)) &&
        tells(&ValuePlace::column,
              manifest_.tile_begins[0] + (order == ScanOrder::kRaster ? 0 : width - 1)) &&
        2 * columns >= static_cast<std::size_t>(width - 1) && width > 2 &&
        is_as_others(in_second_column_, columns)) {
      add("columns_after_first",
          order == ScanOrder::kRaster
              ? "the first column is equal, those after it differ: what comes from the pixel to the left"
              : "the last column is equal, those before it differ: what comes from the pixel to the right");
    }
  }

  // Whether a line has at least a quarter of the differences that those with any have on the average: what
  // comes from the line before grows from line to line.
  bool is_as_others(std::uint64_t in_line, std::size_t lines) const {
    return 4 * in_line * lines >= comparison_.different_values;
  }

  bool is_one_disparity() const { return comparison_.disparities.size() == 1; }

  void find_disparities() {
    const std::int64_t first = *stream_.shape.first_disparity;
    const auto per_pixel = static_cast<std::int64_t>(stream_.shape.tokens_per_pixel * fields_.size());
    if (is_one_disparity()) {
      const std::int64_t only = comparison_.disparities.begin()->first;
      const char* const name = only == first + per_pixel - 1 ? "only_last_disparity"
                               : only == first               ? "only_first_disparity"
                                                             : "one_disparity";
      add(name, fmt::format("only disparity {} differs{}", only,
                            only == first + per_pixel - 1 ? ", the last one"
                            : only == first               ? ", the first one"
                                                          : ""));
    } else if (groups_.size() == 1 && stream_.shape.tokens_per_pixel > 1) {
      add("one_group",
          fmt::format("only iteration {} of each pixel differs, disparities {} to {}", *groups_.begin(),
                      comparison_.disparities.begin()->first, comparison_.disparities.rbegin()->first));
    }
  }

  const TokenComparison& comparison_;
  const VectorManifest& manifest_;
  const VectorStream& stream_;
  const std::vector<TokenField>& fields_;
  const TokenWords& expected_;
  const std::uint64_t tokens_;  // that both have
  DifferenceRegions found_;
  std::set<std::int64_t> frames_, tiles_, columns_;
  std::set<std::uint64_t> groups_;
  std::int64_t last_frame_ = 0, last_tile_ = 0, last_column_ = 0;
  std::uint64_t last_group_ = 0;
  Extent row_extent_, column_extent_;
  std::uint64_t in_second_row_ = 0, in_second_column_ = 0;  // values that differ, in the order of the tokens
  // How far the differences reach from the tile's borders, px.
  std::int64_t rim_ = 0, left_ = 0, right_ = 0, top_ = 0, bottom_ = 0;
  // And how near they come.
  std::int64_t left_least_ = INT64_MAX, right_least_ = INT64_MAX, top_least_ = INT64_MAX,
               bottom_least_ = INT64_MAX;
};

}  // namespace

DifferenceRegions find_regions(const TokenComparison& comparison, const TokenWords& expected,
                               const TokenWords& got) {
  return RegionSearch(comparison, expected, got).find();
}

}  // namespace parallax
