// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/difference_pattern.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>

namespace parallax {
namespace {

constexpr std::size_t kSamples = 200;  // differing tokens that a guess must explain before all are looked at
constexpr std::int64_t kWidestRim = 16;      // px; 31 x 31 is the largest usual window
constexpr std::size_t kLeastExplained = 2;   // tokens: one alone follows any rule
constexpr std::uint64_t kLeastBetween = 16;  // tokens that agree between two that are lost

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
    if (find_ends()) return found_;
    if (comparison_.unknown_tokens == comparison_.different_tokens) {
      add("unknown_bits", "all that differ have unknown bits (x or z)");
    } else if (comparison_.different_tokens >= kLeastExplained) {
      if (!find_constant()) {
        find_lost();
        find_delay();
        find_values();
        find_lost_here_and_there();
      }
    }
    find_regions();
    if (found_.empty() && comparison_.different_tokens == 1) add("one_token", "one token alone");
    if (found_.empty()) add("none", "none of those known: scattered over the image");
    return found_;
  }

 private:
  void add(const std::string& name, const std::string& text) { found_.push_back({name, text}); }

  std::string place_text(std::uint64_t token) const {
    const ValuePlace place = manifest_.place(stream_, token, 0);
    if (place.row < 0) return fmt::format("token {} (frame {})", token, place.frame);
    return fmt::format("token {} (frame {}, row {}, column {})", token, place.frame, place.row, place.column);
  }

  // All that both have is equal: one of them goes on.
  bool find_ends() {
    if (comparison_.different_tokens > 0) return false;
    if (comparison_.got_tokens < comparison_.expected_tokens) {
      add("truncated", fmt::format("it ends before {}, all before that is equal", place_text(tokens_)));
    } else {
      add("surplus", "more tokens at the end, all before them are equal");
    }
    return true;
  }

  bool find_constant() {
    for (std::uint64_t token = 1; token < got_.size(); ++token) {
      if (!got_.same(token, got_, 0)) return false;
    }
    add("constant", "all its tokens are the same");
    return true;
  }

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
        add("token_lost", fmt::format("{} is lost, all others are there", place_text(at)));
      } else {
        add("tokens_lost",
            fmt::format("{} tokens are lost from {} on, all others are there", lost, place_text(at)));
      }
    } else if (difference >= 0 && at > 0 && shifted(extra, at + static_cast<std::uint64_t>(extra))) {
      const bool twice = extra == 1 && got_.same(at, expected_, at - 1);
      add(twice ? "token_doubled" : "tokens_inserted",
          fmt::format("{} before {}, all others are there",
                      twice ? "a token comes twice" : fmt::format("{} too many", extra), place_text(at)));
    }
  }

  // Tokens that are lost, or that come in addition, one here and one there: found by going through both and
  // leaving one out where the next ones then agree.
  void find_lost_here_and_there() {
    if (!found_.empty()) return;
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
    lost += expected_.size() - from;
    inserted += got_.size() - at;
    if (!first || lost + inserted < kLeastExplained) return;
    const bool few = lost >= inserted;
    add(few ? "tokens_lost" : "tokens_inserted",
        fmt::format("{} tokens are {}, the first one {}{}, all others are there", few ? lost : inserted,
                    few ? "lost" : "too many", few ? "" : "before ", place_text(*first)));
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
    if (!found_.empty()) return;
    const std::uint64_t row = stream_.shape.row_tokens;
    const std::uint64_t pixel = stream_.shape.tokens_per_pixel;
    const std::uint64_t most = std::min<std::uint64_t>(tokens_ / 2, 4 * row + 64);
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
    const auto row = static_cast<std::int64_t>(stream_.shape.row_tokens);
    const auto matches = [&](std::uint64_t i) {
      const std::int64_t in_row = static_cast<std::int64_t>(i) % row - late;
      return in_row < 0 || in_row >= row || got_.same(i, expected_, i - static_cast<std::uint64_t>(late));
    };
    return std::all_of(differing_.begin(), differing_.end(), matches) && all_tokens(matches);
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
    first_column_ = std::min(first_column_, x);
    first_row_ = std::min(first_row_, place.row);
    note(columns_, last_column_, x);
  }

  // "the first 3 columns"
  static std::string border(const char* which, std::int64_t number, const char* what) {
    if (number == 1) return fmt::format("only the {} {} differs", which, what);
    return fmt::format("only the {} {} {}s differ", which, number, what);
  }

  void find_regions() {
    if (comparison_.different_tokens == 0) return;
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

  void find_image_regions() {
    const std::int64_t width = manifest_.tile_width;
    const std::int64_t height = manifest_.height;
    const auto is_small = [](std::int64_t reach, std::int64_t size) {
      return reach < kWidestRim && 4 * (reach + 1) <= size;
    };
    const std::size_t before = found_.size();
    if (is_small(top_, height)) add("only_first_rows", border("first", top_ + 1, "row"));
    if (is_small(bottom_, height)) add("only_last_rows", border("last", bottom_ + 1, "row"));
    if (is_small(left_, width)) add("only_first_columns", border("first", left_ + 1, "column"));
    if (is_small(right_, width)) add("only_last_columns", border("last", right_ + 1, "column"));
    if (found_.size() == before && is_small(rim_, std::min(width, height)))
      add("only_rim", fmt::format("only the rim differs, {} px wide", rim_ + 1));
    const std::size_t rows = comparison_.rows.size();
    if (first_row_ == 1 && 2 * rows >= static_cast<std::size_t>(height - 1) && height > 2) {
      add("rows_after_first", "the first row is equal, those after it differ: what comes from the row above");
    }
    if (first_column_ == 1 && 2 * columns_.size() >= static_cast<std::size_t>(width - 1) && width > 2) {
      add("columns_after_first",
          "the first column is equal, those after it differ: what comes from the pixel to the left");
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
  std::int64_t first_row_ = INT64_MAX, first_column_ = INT64_MAX;
};

}  // namespace

std::vector<DifferencePattern> find_patterns(const TokenComparison& comparison, const TokenWords& expected,
                                             const TokenWords& got) {
  return PatternSearch(comparison, expected, got).find();
}

}  // namespace parallax
