// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/lost_tokens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>

#include "platform/cosim/doubled_tokens.hpp"
#include "platform/cosim/pattern_evidence.hpp"
#include "platform/cosim/stream_end.hpp"

namespace parallax {
namespace {

constexpr std::uint64_t kLeastBetween = 16;  // tokens that agree between two that are lost
constexpr std::uint64_t kPaddingShare = 4;   // of all tokens, at most, fill up what was lost
constexpr std::uint64_t kMostAtOnce = 64;    // that are lost at one place of several, or a row of them

class LostTokens {
 public:
  LostTokens(const TokenComparison& comparison, const TokenWords& expected, const TokenWords& got,
             const std::vector<std::uint64_t>& differing)
      : comparison_(comparison),
        shape_(comparison.stream->shape),
        row_(shape_.row_tokens),
        expected_(expected),
        got_(got),
        differing_(differing),
        padding_(std::max(constant_from(got), got.size() - got.size() / kPaddingShare)) {}

  std::vector<DifferencePattern> find() {
    find_at_one_place();
    if (found_.empty()) find_in_each_row();
    if (found_.empty()) {
      if (const auto doubled = find_doubled_tokens(comparison_, expected_, got_)) found_.push_back(*doubled);
    }
    if (found_.empty()) find_here_and_there();
    return found_;
  }

 private:
  void add(const std::string& name, const std::string& text) { found_.push_back({name, text}); }
  std::string place_of(std::uint64_t token) const { return place_text(comparison_, token); }

  // Whether got[i] is expected[i + lost - extra] for all i from `from` on for which both are there. That
  // tokens are lost or too many the length says too, unless it is the model's.
  bool follows(std::uint64_t lost, std::uint64_t extra, std::uint64_t from) const {
    const std::uint64_t padding = got_.size() == expected_.size() && lost > 0 ? padding_ : got_.size();
    const auto is_there = [&](std::uint64_t i) { return i + lost < expected_.size() + extra && i < padding; };
    const auto matches = [&](std::uint64_t i) {
      return !is_there(i) || got_.same(i, expected_, i + lost - extra);
    };
    std::size_t explained = 0;
    for (const std::uint64_t i : differing_) {
      if (i < from) continue;
      if (!matches(i)) return false;
      explained += is_there(i) ? 1 : 0;
    }
    if (explained < (got_.size() == expected_.size() ? kLeastMoved : kLeastExplained)) return false;
    for (std::uint64_t i = from; i < got_.size(); ++i) {
      if (!matches(i)) return false;
    }
    return true;
  }

  void find_at_one_place() {
    const std::uint64_t at = comparison_.first->token;
    const std::uint64_t expected = comparison_.expected_tokens, got = comparison_.got_tokens;
    // Of equal length, what is lost may be filled up with what comes behind it.
    const std::uint64_t difference = std::max(expected, got) - std::min(expected, got);
    for (const std::uint64_t number :
         difference > 0 ? std::vector{difference} : std::vector{std::uint64_t{1}, row_}) {
      if (number == 0 || (at == 0 && difference == 0)) continue;
      if (got <= expected && follows(number, 0, at)) return tell_lost(number, at);
      if (got >= expected && at > 0 && follows(0, number, at + number)) return tell_inserted(number, at);
    }
  }

  // The row that `at` lies in: "row 3 (frame 0)".
  std::string row_text(std::uint64_t at, std::uint64_t rows) const {
    const ValuePlace place = comparison_.manifest->place(*comparison_.stream, at, 0);
    const ValuePlace last = comparison_.manifest->place(*comparison_.stream, at + (rows - 1) * row_, 0);
    const std::string tile =
        comparison_.manifest->tile_begins.size() > 1 ? fmt::format(", tile {}", place.tile) : "";
    if (rows == 1) return fmt::format("row {} (frame {}{})", place.row, place.frame, tile);
    return fmt::format("{} rows from row {} (frame {}{}) to row {}", rows, place.row, place.frame, tile,
                       last.row);
  }

  void tell_lost(std::uint64_t lost, std::uint64_t at) {
    if (row_ > 0 && lost % row_ == 0) {
      // The first tokens of the row that is lost may be those of the next one.
      const std::uint64_t begin = at - at % row_;
      bool is_row = true;
      for (std::uint64_t i = begin; i < at; ++i) is_row = is_row && expected_.same(i, expected_, i + lost);
      if (is_row) {
        const std::uint64_t rows = lost / row_;
        return add(rows == 1 ? "row_lost" : "rows_lost",
                   fmt::format("{} {} lost, all other tokens are there", row_text(begin, rows),
                               rows == 1 ? "is" : "are"));
      }
    }
    if (lost == 1) return add("token_lost", fmt::format("{} is lost, all others are there", place_of(at)));
    add("tokens_lost",
        fmt::format("{} tokens are lost from {} on, all others are there", lost, place_of(at)));
  }

  void tell_inserted(std::uint64_t extra, std::uint64_t at) {
    const std::uint64_t begin = row_ > 0 ? at - at % row_ : 0;
    if (row_ > 0 && extra % row_ == 0 && begin > 0 && follows(0, extra, begin + extra)) {
      bool is_twice = extra == row_;
      for (std::uint64_t i = begin; i < begin + row_ && is_twice; ++i)
        is_twice = got_.same(i, expected_, i - row_);
      if (is_twice) {
        return add("row_doubled",
                   row_text(begin - row_, 1) + " comes twice, all other tokens are there once");
      }
      const std::uint64_t rows = extra / row_;
      return add("rows_inserted", fmt::format("{} {} too many before {}, all others are there", rows,
                                              rows == 1 ? "row" : "rows", row_text(begin, 1)));
    }
    const bool twice = extra == 1 && got_.same(at, expected_, at - 1);
    add(twice ? "token_doubled" : "tokens_inserted",
        fmt::format("{} before {}, all others are there",
                    twice ? "a token comes twice" : fmt::format("{} too many", extra), place_of(at)));
  }

  enum class Column { kLost, kTwice, kInserted };

  // Whether the stream is the model's without pixel `pixel` of each row, with that one twice, or with some
  // other behind it.
  bool has_rows(std::uint64_t pixel, Column kind) const {
    const bool twice = kind != Column::kLost;
    const std::uint64_t unit = shape_.tokens_per_pixel;
    const std::uint64_t length = twice ? row_ + unit : row_ - unit;
    const std::uint64_t same_until = (twice ? pixel + 1 : pixel) * unit;
    const std::uint64_t size = std::min(got_.size(), expected_.size() / row_ * length);
    const auto matches = [&](std::uint64_t i) {
      if (i >= size) return true;
      const std::uint64_t in_row = i % length;
      if (kind == Column::kInserted && in_row >= same_until && in_row < same_until + unit) return true;
      const std::uint64_t from = in_row < same_until ? in_row : twice ? in_row - unit : in_row + unit;
      return got_.same(i, expected_, i / length * row_ + from);
    };
    if (!std::all_of(differing_.begin(), differing_.end(), matches)) return false;
    for (std::uint64_t i = 0; i < size; ++i) {
      if (!matches(i)) return false;
    }
    return true;
  }

  void find_in_each_row() {
    const std::uint64_t unit = shape_.tokens_per_pixel;
    if (row_ <= 2 * unit || comparison_.different_tokens < kLeastMoved) return;
    for (const Column kind : {Column::kLost, Column::kTwice, Column::kInserted}) {
      std::optional<std::uint64_t> first, last;  // of the pixels that may be it, where neighbours are alike
      for (std::uint64_t pixel = 0; pixel < row_ / unit; ++pixel) {
        if (!has_rows(pixel, kind)) continue;
        if (!first) first = pixel;
        last = pixel;
      }
      if (!first) continue;
      if (kind == Column::kInserted) {
        return add(
            "column_inserted",
            fmt::format("each row has one more, behind {}, all other tokens are there: row r is r {} late",
                        column_text(*first, *last), unit == 1 ? "tokens" : "pixels"));
      }
      const bool twice = kind == Column::kTwice;
      return add(twice ? "column_doubled" : "column_lost",
                 fmt::format("{} {}, all other tokens are there", column_text(*first, *last),
                             twice ? "comes twice" : "is lost"));
    }
  }

  std::string column_text(std::uint64_t first, std::uint64_t last) const {
    const auto column = [this](std::uint64_t pixel) {
      const ValuePlace place =
          comparison_.manifest->place(*comparison_.stream, pixel * shape_.tokens_per_pixel, 0);
      return place.column - comparison_.manifest->tile_begins[0];
    };
    if (shape_.pixels_per_token > 1) return fmt::format("a token of each row, its token {},", last);
    if (first == last) return fmt::format("column {} of each row", column(first));
    return fmt::format("a column of each row, one of {} to {},", column(first), column(last));
  }

  // Found by going through both and leaving some of the longer one out where the next ones then agree. Of
  // equal length nothing is: where many are alike, as in a flat image, a token of another value would be one
  // too many, and lost at the flat part's end.
  void find_here_and_there() {
    const bool is_lost = got_.size() < expected_.size();
    if (got_.size() == expected_.size()) return;
    std::uint64_t skipped = 0, at = 0, from = 0, places = 0;
    std::optional<std::uint64_t> first;
    std::set<std::int64_t> columns;
    while (at < got_.size() && from < expected_.size()) {
      if (got_.same(at, expected_, from)) {
        ++at;
        ++from;
        continue;
      }
      if (++places > got_.size() / kLeastBetween) return;
      if (!first) first = from;
      if (columns.size() < 2)
        columns.insert(comparison_.manifest->place(*comparison_.stream, from, 0).column);
      const std::uint64_t number = next_agreeing(at, from, is_lost);
      if (number == 0) return;
      skipped += number;
      (is_lost ? from : at) += number;
    }
    const std::uint64_t missing = expected_.size() - from, more = got_.size() - at;
    if (!first || skipped < kLeastExplained || (is_lost ? more : missing) > 0) return;
    const bool in_one_column = places > 1 && columns.size() == 1 && *columns.begin() >= 0;
    const std::uint64_t end = is_lost ? missing : more;
    add(is_lost ? "tokens_lost" : "tokens_inserted",
        fmt::format("{} tokens are {} at {}{}, the first one {}{}, all others are there{}", skipped,
                    is_lost ? "lost" : "too many",
                    places == 1 ? "one place" : fmt::format("{} places", places),
                    in_one_column ? fmt::format(", each in column {}", *columns.begin()) : "",
                    is_lost ? "" : "before ", place_of(*first),
                    end == 0 ? "" : fmt::format(" but for the last {}", end)));
  }

  // How many to leave out so that most of the next ones agree, or, where some of these are lost too, fewer.
  // 0: none can be.
  std::uint64_t next_agreeing(std::uint64_t at, std::uint64_t from, bool is_lost) const {
    for (const std::uint64_t least : {kLeastBetween, kLeastBetween / 4, std::uint64_t{1}}) {
      for (std::uint64_t number = 1; number <= std::max(kMostAtOnce, row_); ++number) {
        if (is_lost ? agree(at, from + number, least) : agree(at + number, from, least)) return number;
      }
    }
    return 0;
  }

  // Whether the next so many tokens are the same, as far as there are any.
  bool agree(std::uint64_t at, std::uint64_t from, std::uint64_t tokens) const {
    for (std::uint64_t i = 0; i < tokens; ++i) {
      if (at + i >= got_.size() || from + i >= expected_.size()) return i > 0;
      if (!got_.same(at + i, expected_, from + i)) return false;
    }
    return true;
  }

  const TokenComparison& comparison_;
  const TokenShape& shape_;
  const std::uint64_t row_;  // tokens; 0: they know no rows
  const TokenWords& expected_;
  const TokenWords& got_;
  const std::vector<std::uint64_t>& differing_;
  const std::uint64_t padding_;  // from which token on all are the same, and may stand for those lost
  std::vector<DifferencePattern> found_;
};

}  // namespace

std::vector<DifferencePattern> find_lost_tokens(const TokenComparison& comparison, const TokenWords& expected,
                                                const TokenWords& got,
                                                const std::vector<std::uint64_t>& differing) {
  return LostTokens(comparison, expected, got, differing).find();
}

}  // namespace parallax
