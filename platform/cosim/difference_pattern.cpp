// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/difference_pattern.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <set>

#include "platform/cosim/path_origin.hpp"
#include "platform/cosim/token_shift.hpp"
#include "platform/cosim/value_difference.hpp"

namespace parallax {
namespace {

constexpr std::size_t kSamples = 200;  // differing tokens that a guess must explain before all are looked at
constexpr std::int64_t kWidestRim = 16;  // px; 31 x 31 is the largest usual window
// Differences that the rim would have if they were spread evenly: none there is then no chance (e^-8).
constexpr double kMissedInRim = 8;

// "path nw" of path_nw.
std::string words_of(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

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

class PatternSearch {
 public:
  PatternSearch(const TokenComparison& comparison, const TokenWords& expected, const TokenWords& got)
      : comparison_(comparison),
        manifest_(*comparison.manifest),
        stream_(*comparison.stream),
        fields_(stream_.shape.format.all()),
        expected_(expected),
        got_(got),
        tokens_(comparison.compared_tokens) {
    for_each_difference(stream_, expected, got, [this](std::uint64_t token, std::size_t field) {
      note_place(token, field);
      if (differing_.empty() || differing_.back() != token) {
        if (differing_.size() < kSamples) differing_.push_back(token);
      }
    });
  }

  std::vector<DifferencePattern> find() {
    if (comparison_.different_tokens == 0) return find_end(comparison_);
    if (comparison_.unknown_tokens == comparison_.different_tokens) {
      add("unknown_bits", "all that differ have unknown bits (x or z)");
    } else if (comparison_.different_tokens >= kLeastExplained) {
      if (!find_constant()) {
        found_ = find_shift(comparison_, expected_, got_, differing_);
        find_values();
        if (found_.empty()) find_origin();
      }
    }
    find_regions();
    if (found_.empty() && comparison_.different_tokens >= kLeastExplained) {
      if (const auto values = find_value_difference(stream_, expected_, got_)) found_.push_back(*values);
    }
    if (found_.empty() && comparison_.different_tokens == 1) add("one_token", "one token alone");
    if (found_.empty()) add("none", "none of those known: scattered over the image");
    return found_;
  }

 private:
  void add(const std::string& name, const std::string& text) { found_.push_back({name, text}); }

  void find_origin() {
    if (const auto origin = find_path_origin(comparison_, expected_, got_)) found_.push_back(*origin);
  }

  bool find_constant() {
    for (std::uint64_t token = 1; token < got_.size(); ++token) {
      if (!got_.same(token, got_, 0)) return false;
    }
    add("constant", "all its tokens are the same");
    return true;
  }

  template <class Matches>
  bool all_tokens(const Matches& matches) const {
    for (std::uint64_t i = 0; i < tokens_; ++i) {
      if (!matches(i)) return false;
    }
    return true;
  }

  // Whether each value that is known is what `rule` says of the model's.
  using Rule = std::function<bool(std::uint64_t expected, std::uint64_t got, std::size_t width)>;
  bool follows(const Rule& rule) const {
    const auto matches = [&](std::uint64_t token) {
      return std::all_of(fields_.begin(), fields_.end(), [&](const TokenField& field) {
        return !got_.unknown(token, field) &&
               rule(expected_.raw(token, field), got_.raw(token, field), field.width);
      });
    };
    return std::all_of(differing_.begin(), differing_.end(), matches) && all_tokens(matches);
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
    if (!found_.empty()) return;
    const bool whole_bytes = std::all_of(fields_.begin(), fields_.end(),
                                         [](const TokenField& field) { return field.width % 8 == 0; });
    const bool alike = std::all_of(fields_.begin(), fields_.end(), [this](const TokenField& field) {
      return field.width == fields_.front().width;
    });
    if (follows([](auto e, auto g, auto width) { return g == (~e & mask(width)); })) {
      add("inverted", "all bits are inverted");
    } else if (follows([](auto e, auto g, auto width) { return g == reversed_bits(e, width); }) ||
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
    std::uint64_t changed = 0;
    for (std::uint64_t token = 0; token < tokens_; ++token) {
      for (const TokenField& field : fields_) {
        largest = std::max(largest, got_.raw(token, field));
        changed |= got_.raw(token, field) ^ expected_.raw(token, field);
      }
    }
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
    } else if (width > 2 && follows([](auto e, auto g, auto) { return (e & g) == 0; })) {
      add("inverted_comparison", "no bit is 1 in both: the comparison is the other way round");
    } else if ((changed & (changed - 1)) == 0) {
      std::size_t bit = 0;
      while (changed >> bit != 1) ++bit;
      add("one_bit", fmt::format("only bit {} of the values differs", bit));
    }
  }

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
    if (manifest_.frames > 1 && frames_.size() < static_cast<std::size_t>(manifest_.frames)) {
      if (frames_.count(0) == 0 && frames_.size() + 1 == static_cast<std::size_t>(manifest_.frames))
        add("frames_after_first",
            "the first frame is equal, all others differ: something is left over of it");
      if (frames_.size() == 1 && frames_.count(0) == 1)
        add("only_first_frame", "only the first frame differs");
    }
    if (manifest_.tile_begins.size() > 1 && tiles_.size() == 1)
      add("one_tile", fmt::format("only tile {} differs", *tiles_.begin()));
  }

  // Width of the rim in which nothing differs on any side, px; 0 also where none need differ there: so little
  // does elsewhere, or the rim is all the same, as if masked.
  std::int64_t equal_rim() const {
    const std::initializer_list<std::int64_t> sides = {left_least_, right_least_, top_least_, bottom_least_};
    if (std::max(sides) > kWidestRim) return 0;  // it lies in one part of the image
    const std::int64_t rim = std::min(sides);
    const std::int64_t width = manifest_.tile_width, height = manifest_.height;
    const std::int64_t inside = (width - 2 * rim) * (height - 2 * rim);
    const double share = 1 - static_cast<double>(inside) / static_cast<double>(width * height);
    const double pixels = quotient(comparison_.different_tokens, stream_.shape.tokens_per_pixel);
    if (pixels * share < kMissedInRim) return 0;
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
    const std::int64_t height = manifest_.height;
    const auto is_small = [](std::int64_t reach, std::int64_t size) {
      return reach < kWidestRim && 4 * (reach + 1) <= size;
    };
    const std::size_t before = found_.size();
    // Most of them, or they are no border but lines near it.
    const auto is_border = [&](std::int64_t reach, std::int64_t size, std::size_t lines) {
      return is_small(reach, size) && 2 * static_cast<std::int64_t>(lines) > reach + 1;
    };
    const std::size_t rows = comparison_.rows.size(), columns = columns_.size();
    if (is_border(top_, height, rows)) add("only_first_rows", border("first", top_ + 1, "row"));
    if (is_border(bottom_, height, rows)) add("only_last_rows", border("last", bottom_ + 1, "row"));
    if (is_border(left_, width, columns)) add("only_first_columns", border("first", left_ + 1, "column"));
    if (is_border(right_, width, columns)) add("only_last_columns", border("last", right_ + 1, "column"));
    if (found_.size() == before && rows == 1)
      add("one_row", fmt::format("only row {} differs", comparison_.rows.begin()->first));
    if (found_.size() == before && columns == 1)
      add("one_column", fmt::format("only column {} differs", *columns_.begin()));
    const std::int64_t within = (width - 2 * (rim_ + 1)) * (height - 2 * (rim_ + 1));
    if (found_.size() == before && is_small(rim_, std::min(width, height)) && 2 * within >= width * height)
      add("only_rim", fmt::format("only the rim differs, {} px wide", rim_ + 1));
    if (const std::int64_t equal = equal_rim(); equal > 0 && is_small(equal - 1, std::min(width, height))) {
      add("all_but_rim",
          fmt::format("the rim is equal, {} px wide, what lies inside it differs: what comes from "
                      "all around a pixel",
                      equal));
      return;
    }
    const ScanOrder order = stream_.shape.order;
    const std::int64_t first_row = order == ScanOrder::kTurned ? bottom_least_ : top_least_;
    const std::int64_t first_column = order == ScanOrder::kRaster ? left_least_ : right_least_;
    const auto tells = [&](std::int64_t ValuePlace::*of, std::int64_t line) { return !is_same(of, line); };
    if (first_row == 1 && tells(&ValuePlace::row, order == ScanOrder::kTurned ? height - 1 : 0) &&
        2 * rows >= static_cast<std::size_t>(height - 1) && height > 2) {
      add("rows_after_first",
          order == ScanOrder::kTurned
              ? "the last row is equal, those above it differ: what comes from the row below"
              : "the first row is equal, those after it differ: what comes from the row above");
    }
    if (first_column == 1 &&
        tells(&ValuePlace::column,
              manifest_.tile_begins[0] + (order == ScanOrder::kRaster ? 0 : width - 1)) &&
        2 * columns >= static_cast<std::size_t>(width - 1) && width > 2) {
      add("columns_after_first",
          order == ScanOrder::kRaster
              ? "the first column is equal, those after it differ: what comes from the pixel to the left"
              : "the last column is equal, those before it differ: what comes from the pixel to the right");
    }
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
  const TokenWords& got_;
  const std::uint64_t tokens_;  // that both have
  std::vector<DifferencePattern> found_;
  std::vector<std::uint64_t> differing_;  // the first of them
  std::set<std::int64_t> frames_, tiles_, columns_;
  std::set<std::uint64_t> groups_;
  std::int64_t last_frame_ = 0, last_tile_ = 0, last_column_ = 0;
  std::uint64_t last_group_ = 0;
  // How far the differences reach from the tile's borders, px.
  std::int64_t rim_ = 0, left_ = 0, right_ = 0, top_ = 0, bottom_ = 0;
  // And how near they come.
  std::int64_t left_least_ = INT64_MAX, right_least_ = INT64_MAX, top_least_ = INT64_MAX,
               bottom_least_ = INT64_MAX;
};

}  // namespace

std::vector<DifferencePattern> find_patterns(const TokenComparison& comparison, const TokenWords& expected,
                                             const TokenWords& got) {
  std::vector<DifferencePattern> found = PatternSearch(comparison, expected, got).find();
  if (!comparison.stream->is_tap) return found;
  for (DifferencePattern& pattern : found)
    pattern.text = words_of(comparison.stream->name) + ": " + pattern.text;
  return found;
}

}  // namespace parallax
