// SPDX-License-Identifier: Apache-2.0
// What a comparison of a dump with vectors says, on dumps that were altered in known ways.
#include "platform/cosim/token_comparison.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "modules/token_formats.hpp"
#include "tests/platform/altered_dump.hpp"

namespace parallax {
namespace token_comparison_test {

using test::codes;
using test::costs;
using test::Words;

class AlteredDump : public test::AlteredDump {};

TEST_F(AlteredDump, TheFirstDifferenceIsPlaced) {
  make(codes(40, 24), 40, 30, 2);
  Words got = words_;
  got[1200 + 7 * 40 + 3][0] ^= 1;
  got[1200 + 9 * 40 + 5][0] ^= 2;
  const TokenComparison comparison = compare(got);
  ASSERT_TRUE(comparison.first.has_value());
  EXPECT_EQ(comparison.first->place.frame, 1);
  EXPECT_EQ(comparison.first->place.row, 7);
  EXPECT_EQ(comparison.first->place.column, 3);
  EXPECT_EQ(comparison.first->place.disparity, -1);
  EXPECT_EQ(comparison.first->expected, fmt::format("0x{:x}", words_[1483][0]));
  EXPECT_EQ(comparison.different_tokens, 2U);
  EXPECT_EQ(comparison.rows, (std::map<std::int64_t, std::uint64_t>{{7, 1}, {9, 1}}));
  EXPECT_EQ(comparison.columns, (std::map<std::int64_t, std::uint64_t>{{3, 1}, {5, 1}}));
  EXPECT_TRUE(compare(words_).equal());
  EXPECT_EQ(text(compare(words_)), "left_codes: equal, 2400 tokens\n");
}

TEST_F(AlteredDump, ACostIsPlacedByItsDisparity) {
  make(costs(8, 4, 16), 8, 6);
  Words got = words_;
  got[(5 * 8 + 2) * 4 + 3][15] ^= 1;
  const TokenComparison comparison = compare(got);
  EXPECT_EQ(comparison.first->place.row, 5);
  EXPECT_EQ(comparison.first->place.column, 2);
  EXPECT_EQ(comparison.first->place.disparity, 10 + 63);
  EXPECT_EQ(comparison.patterns.front().name, "only_last_disparity");
  const std::string expected = std::to_string(words_[171][15]), other = std::to_string(words_[171][15] ^ 1);
  EXPECT_EQ(text(comparison),
            "left_codes: 1 of 192 tokens differ\n"
            "first difference    frame 0, row 5, column 2, disparity 73, cost_15 of token 171: expected " +
                expected + ", got " + other +
                "\n"
                "pattern             only disparity 73 differs, the last one\n"
                "where               row 5\n"
                "                    column 2\n"
                "                    disparity 73\n");
}

TEST_F(AlteredDump, SeveralPixelsATokenAreColumnsOfTheirOwn) {
  TokenShape shape(gray_format().several(4));
  shape.row_tokens = 10;
  shape.pixels_per_token = 4;
  make(shape, 40, 6);
  Words got = words_;
  got[2 * 10 + 3][1] ^= 1;
  EXPECT_EQ(compare(got).first->place.row, 2);
  EXPECT_EQ(compare(got).first->place.column, 13);
}

TEST_F(AlteredDump, APartOfTheImage) {
  make(codes(64, 24), 64, 48);
  const auto is_in = [](auto where) {
    return [where](const ValuePlace& place, std::uint64_t value) {
      return where(place.column, place.row) ? value + 1 + static_cast<std::uint64_t>(place.column % 3)
                                            : value;
    };
  };
  EXPECT_EQ(pattern(is_in([](auto, auto y) { return y == 0; })), "only_first_rows");
  EXPECT_EQ(pattern(is_in([](auto, auto y) { return y >= 46; })), "only_last_rows");
  EXPECT_EQ(pattern(is_in([](auto x, auto) { return x < 2; })), "only_first_columns");
  EXPECT_EQ(pattern(is_in([](auto x, auto) { return x == 63; })), "only_last_columns");
  EXPECT_EQ(pattern(is_in([](auto x, auto y) { return x < 2 || y < 2 || x > 61 || y > 45; })), "only_rim");
  EXPECT_EQ(pattern(is_in([](auto, auto y) { return y > 0; })), "rows_after_first");
  EXPECT_EQ(pattern(is_in([](auto x, auto) { return x > 0; })), "columns_after_first");
  EXPECT_EQ(pattern(is_in([](auto x, auto y) { return (x * 7 + y * 13) % 50 == 3; })), "none");
}

// A plain median, or a window that is masked, leaves the rim as it is.
TEST_F(AlteredDump, AllButTheRim) {
  make(codes(64, 24), 64, 48, 2);
  const auto said = [this](auto where) {
    Words got = words_;
    for (std::uint64_t token = 0; token < got.size(); ++token) {
      const ValuePlace place = manifest_.place(stream(), token, 0);
      if (where(place.column, place.row)) got[token][0] ^= 1 + token % 5;
    }
    return compare(got).patterns.front().text;
  };
  const auto rim = [](int px) {
    return fmt::format(
        "the rim is equal, {} px wide, what lies inside it differs: what comes from all around a "
        "pixel",
        px);
  };
  const auto inside = [](auto x, auto y, int px) { return x >= px && x < 64 - px && y >= px && y < 48 - px; };
  for (const int px : {1, 3, 12}) {
    EXPECT_EQ(said([&](auto x, auto y) { return inside(x, y, px); }), rim(px));
    EXPECT_EQ(said([&](auto x, auto y) { return inside(x, y, px) && (x + y) % 4 != 3; }), rim(px));
  }
  // Of the widths on each side, the least.
  EXPECT_EQ(said([&](auto x, auto y) { return inside(x, y, 1) && x > 4 && y < 40; }), rim(1));
  const std::string none = "none of those known: scattered over the image";
  // A rim wider than any window's.
  EXPECT_EQ(said([&](auto x, auto y) { return inside(x, y, 13); }), none);
  // Some at the border.
  EXPECT_EQ(said([&](auto x, auto y) { return inside(x, y, 1) || (x == 63 && y == 20); }).substr(0, 22),
            "the first row is equal");
  EXPECT_EQ(said([&](auto x, auto y) { return inside(x, y, 1) || (x == 20 && y == 0); }).substr(0, 25),
            "the first column is equal");
  // Of 82 differences in 6144 tokens, some six would lie in the rim by chance; of 110, eight. Nor does it say
  // anything that so few are in neither the first row nor the first column.
  EXPECT_EQ(said([&](auto x, auto y) { return inside(x, y, 1) && (y * 62 + x) % 69 == 5; }), none);
  EXPECT_EQ(said([&](auto x, auto y) { return inside(x, y, 1) && (y * 62 + x) % 51 == 5; }), rim(1));
  // Of 8 for each row it does; of 8 for each column, that are more, too.
  EXPECT_EQ(said([](auto x, auto y) { return y > 0 && (y * 64 + x) % 15 == 5; }).substr(0, 22),
            "the first row is equal");
  EXPECT_EQ(said([](auto x, auto y) { return y > 0 && (y * 64 + x) % 17 == 5; }), none);
  EXPECT_EQ(said([](auto x, auto y) { return x > 0 && (y * 63 + x) % 11 == 5; }).substr(0, 25),
            "the first column is equal");
  EXPECT_EQ(said([](auto x, auto y) { return x > 0 && (y * 63 + x) % 12 == 5; }), none);
  // A rim that is masked cannot differ.
  for (std::uint64_t token = 0; token < words_.size(); ++token) {
    const ValuePlace place = manifest_.place(stream(), token, 0);
    if (!inside(place.column, place.row, 2)) words_[token][0] = 0xFFF;
  }
  EXPECT_EQ(said([&](auto x, auto y) { return inside(x, y, 2); }), none);
}

// Scattered, but for what the values have in common.
TEST_F(AlteredDump, OtherValues) {
  TokenShape disparities(disparity_format());
  disparities.row_tokens = 64;
  make(disparities, 64, 48);
  for (std::size_t i = 0; i < words_.size(); ++i) words_[i][0] = i % 3 == 0 ? 4095 : words_[i][0] % 4000;
  const auto here = [](const ValuePlace& place) { return (place.column * 7 + place.row * 13) % 10 == 3; };
  const auto value = [&here](auto other) {
    return [&here, other](const ValuePlace& place, std::uint64_t v) { return here(place) ? other(v) : v; };
  };
  EXPECT_EQ(pattern(value([](auto v) { return v == 4095 ? 17 : v; })), "only_validity");  // in a few places
  const auto all = [](auto change) {
    return [change](const ValuePlace&, std::uint64_t v) -> std::uint64_t { return change(v); };
  };
  EXPECT_EQ(pattern(all([](auto v) { return v == 4095 ? 17 : v; })), "invalid_as");
  EXPECT_EQ(
      said(all([](auto v) { return v == 4095 || v % 7 == 1 ? 0 : v; })),
      fmt::format("what is invalid has the value 0; no value is another, only which are valid: 0 are that "
                  "should not be, {} are not that should be",
                  std::count_if(words_.begin(), words_.end(),
                                [](const auto& w) { return w[0] != 4095 && w[0] % 7 == 1; })));
  EXPECT_EQ(pattern(value([](auto) { return 4095; })), "only_validity");
  const auto by = [&](auto way) { return said(value([way](auto v) { return v == 4095 ? v : v + way(v); })); };
  EXPECT_EQ(by([](auto) { return 1; }), "what differs does so by 1, all too high: rounding");
  EXPECT_EQ(by([](auto) { return -1; }), "what differs does so by 1, all too low: rounding");
  EXPECT_EQ(by([](auto v) { return v % 3 == 0 ? 1 : -1; }),
            "what differs does so by 1, some too high and some too low: rounding");
  EXPECT_EQ(pattern(value([](auto v) { return v == 4095 ? v : v ^ (8 + v % 3 * 16); })), "upper_bits");
  EXPECT_EQ(pattern(value([](auto v) { return v == 4095 ? v : v ^ (2 + v % 3 * 16); })), "none");
  make(codes(64, 24), 64, 48);  // of codes, whose bits are no number, neither tells
  EXPECT_EQ(pattern(value([](auto v) { return v ^ (8 + v % 3 * 16); })), "none");
}

// Of a masked window, all that is invalid, and so only a rim differs.
TEST_F(AlteredDump, InvalidAsZeroInTheRim) {
  make(test::image_of(disparity_format(), 64), 64, 48);
  for (std::size_t i = 0; i < words_.size(); ++i) {
    const std::size_t x = i % 64, y = i / 64;
    words_[i][0] = x < 2 || x > 61 || y < 2 || y > 45 ? 4095 : words_[i][0] % 4000;
  }
  EXPECT_EQ(said([](const ValuePlace&, auto v) { return v == 4095 ? 0 : v; }),
            "what is invalid has the value 0; only the rim differs, 2 px wide");
}

// What lies near a border, but not all along it, is no border.
TEST_F(AlteredDump, ABlobIsNoBorder) {
  make(codes(64, 24), 64, 48, 2);
  const auto some = [this](auto is_in) {
    Words got = words_;
    for (std::uint64_t token = 0; token < got.size(); ++token) {
      const ValuePlace place = manifest_.place(stream(), token, 0);
      if (is_in(place.column, place.row)) got[token][0] ^= 5 + token % 3;
    }
    return first_pattern(got);
  };
  EXPECT_EQ(some([](auto x, auto y) { return x >= 4 && x <= 8 && y >= 10 && y <= 14 && (x + y) % 2 == 0; }),
            "none");
  EXPECT_EQ(some([](auto x, auto y) { return y >= 3 && y <= 5 && x >= 10 && x < 13; }), "none");
  EXPECT_EQ(some([](auto x, auto y) { return y == 47 && x % 9 == 2; }), "only_last_rows");
  EXPECT_EQ(some([](auto x, auto y) { return x == 0 && y > 15; }), "only_first_columns");
  Words got = words_;
  got[130][0] ^= 1;
  EXPECT_EQ(first_pattern(got), "one_token");
}

// The first row is equal, but what comes from the row above would show in the second.
TEST_F(AlteredDump, RowsAfterTheFirst) {
  make(codes(64, 24), 64, 48);
  const auto rows = [this](auto is_in) {
    return pattern([&](const ValuePlace& place, auto v) {
      return place.row > 1 || (place.row == 1 && is_in(place.column)) ? v + 1 + v % 3 : v;
    });
  };
  EXPECT_EQ(rows([](auto) { return true; }), "rows_after_first");
  EXPECT_EQ(rows([](auto x) { return x % 2 == 0; }), "rows_after_first");
  EXPECT_EQ(rows([](auto x) { return x == 30; }), "none");
}

// Of a stream that is cut, what did not come is neither equal nor different.
TEST_F(AlteredDump, WhatDidNotComeIsNoPart) {
  make(codes(64, 24), 64, 48, 2);
  const auto cut = [this](std::size_t tokens, auto is_in) {
    Words got(words_.begin(), words_.begin() + static_cast<std::ptrdiff_t>(tokens));
    for (std::size_t i = 0; i < tokens; ++i) {
      if (is_in(i)) got[i][0] ^= 1 + i % 5;
    }
    return first_pattern(got);
  };
  EXPECT_EQ(cut(295, [](auto) { return true; }), "none");
  EXPECT_EQ(cut(64 * 40, [](auto i) { return i < 128; }), "only_first_rows");
  EXPECT_EQ(cut(64 * 48, [](auto i) { return i % 13 == 5; }), "none");
}

// A line near the border is no border, and one that is masked cannot differ.
TEST_F(AlteredDump, LinesOfTheImage) {
  make(codes(64, 24), 64, 48);
  const auto is_in = [](auto where) {
    return [where](const ValuePlace& place, std::uint64_t value) {
      return where(place.column, place.row) ? value + 1 + static_cast<std::uint64_t>(place.column % 3)
                                            : value;
    };
  };
  EXPECT_EQ(pattern(is_in([](auto, auto y) { return y == 10; })), "one_row");
  EXPECT_EQ(pattern(is_in([](auto x, auto) { return x == 13; })), "one_column");
  EXPECT_EQ(pattern(is_in([](auto, auto y) { return y == 10 || y == 11; })), "none");
  // A blob that comes near each side is no rim if that would be most of the image.
  EXPECT_EQ(pattern(is_in([](auto x, auto y) { return x > 8 && x < 12 && y > 3 && y < 44; })), "none");
  for (std::size_t i = 0; i < words_.size(); i += 64) words_[i][0] = 0;
  EXPECT_EQ(pattern(is_in([](auto x, auto) { return x > 0; })), "none");
}

// Where all are alike, a token that has another value is not one too many.
TEST_F(AlteredDump, OtherValuesInAFlatImage) {
  make(codes(64, 24), 64, 48);
  for (auto& word : words_) word = {7};
  words_.back() = {8};
  Words got = words_;
  got[64 * 22 + 30] = {9};
  got[64 * 25 + 33] = {1};
  EXPECT_EQ(first_pattern(got), "none");
}

TEST_F(AlteredDump, AnotherFrameOrTile) {
  make(codes(32, 24), 32, 20, 3);
  const auto later = [](const ValuePlace& place, std::uint64_t value) {
    return place.frame > 0 ? value * 5 + 1 : value;
  };
  EXPECT_EQ(pattern(later), "frames_after_first");
  // In one of three frames none of some 20 is no chance, of a few it may be.
  const auto some = [this](int number, bool in_first) {
    Words got = words_;
    for (int i = 0; i < number; ++i) got[(in_first ? 0 : 640) + i * 37][0] ^= 1 + i % 3;
    return first_pattern(got);
  };
  EXPECT_EQ(some(20, false), "frames_after_first");
  EXPECT_EQ(some(19, false), "none");
  EXPECT_EQ(some(8, true), "only_first_frame");
  EXPECT_EQ(some(7, true), "none");
  manifest_.width = 56;
  manifest_.tile_begins = {0, 24};
  manifest_.frames = 1;
  manifest_.streams.front().frame_tokens = words_.size();
  manifest_.height = 30;
  const auto second = [](const ValuePlace& place, std::uint64_t value) {
    return place.tile == 1 ? value * 5 + 1 : value;
  };
  EXPECT_EQ(pattern(second), "one_tile");
}

TEST_F(AlteredDump, ValuesInAnotherShape) {
  make(codes(40, 24), 40, 30);
  const auto each = [this](auto change) {
    return pattern([change](const ValuePlace&, std::uint64_t value) { return change(value); });
  };
  EXPECT_EQ(each([](auto v) { return ~v; }), "inverted");
  EXPECT_EQ(each([](auto v) {
              std::uint64_t out = 0;
              for (int i = 0; i < 24; ++i) out |= (v >> i & 1U) << (23 - i);
              return out;
            }),
            "bit_order");
  EXPECT_EQ(each([](auto v) { return (v & 0xFF) << 16 | (v & 0xFF00) | v >> 16; }), "byte_order");
  EXPECT_EQ(each([](auto v) { return v + 3; }), "constant_offset");
  EXPECT_EQ(each([](auto v) { return v - 1; }), "constant_offset");
  EXPECT_EQ(each([](auto v) { return v & 0x3FFF; }), "top_bits_lost");
  EXPECT_EQ(each([](auto v) { return std::min<std::uint64_t>(v, 0x90000); }), "saturated");
  EXPECT_EQ(each([](auto v) { return ~v & 0xF0F0F0 & (v * 77); }), "inverted_comparison");
  EXPECT_EQ(each([](auto v) { return v | 0x400; }), "one_bit");
  EXPECT_EQ(each([](auto) { return std::uint64_t{5}; }), "constant");
}

TEST_F(AlteredDump, FieldsInTheOtherOrder) {
  make(costs(8, 2, 16), 8, 30);
  Words got = words_;
  for (auto& word : got) std::reverse(word.begin(), word.end());
  EXPECT_EQ(first_pattern(got), "field_order");
  got = words_;
  for (auto& word : got) word[4] = word[4] * 3 + 1;
  EXPECT_EQ(first_pattern(got), "one_field");
  got = words_;
  for (std::size_t i = 1; i < got.size(); i += 2) got[i][i / 2 % 16] ^= i % 255 + 1;
  EXPECT_EQ(first_pattern(got), "one_group");
  EXPECT_NE(text(compare(got)).find("\n                    disparities 26 to 41 (16 of them), most in "),
            std::string::npos)
      << text(compare(got));
}

TEST_F(AlteredDump, TokensLostDoubledOrLate) {
  make(codes(40, 24), 40, 30);
  EXPECT_EQ(first_pattern(shifted(1)), "one_column_late");
  EXPECT_EQ(first_pattern(shifted(-1)), "one_column_early");
  EXPECT_EQ(first_pattern(shifted(40)), "one_row_late");
  EXPECT_EQ(first_pattern(shifted(-40)), "one_row_early");
  EXPECT_EQ(first_pattern(shifted(17)), "constant_latency");
  Words in_rows = words_;
  for (std::size_t i = 0; i < in_rows.size(); ++i) in_rows[i] = i % 40 == 0 ? words_[3] : words_[i - 1];
  EXPECT_EQ(first_pattern(in_rows), "one_column_late");

  // A window that is moved sees something else at the border of the image.
  const auto moved = [&](std::size_t columns, std::size_t rows) {
    Words out = words_;
    for (std::size_t y = 2; y < 28; ++y) {
      for (std::size_t x = 2; x < 38; ++x) out[y * 40 + x] = words_[(y - rows) * 40 + x - columns];
    }
    return out;
  };
  EXPECT_EQ(first_pattern(moved(1, 0)), "one_column_late");
  EXPECT_EQ(first_pattern(moved(0, 1)), "one_row_late");
  EXPECT_EQ(first_pattern(moved(2, 1)), "moved");
  EXPECT_EQ(compare(moved(2, 1)).patterns.front().text,
            "2 columns late and 1 row late, but for the rim of 2 px");

  Words lost = words_;
  lost.erase(lost.begin() + 500);
  EXPECT_EQ(first_pattern(lost), "token_lost");
  EXPECT_EQ(compare(lost).patterns.front().text,
            "token 500 (frame 0, row 12, column 20) is lost, all others are there");
  lost.push_back({0});
  EXPECT_EQ(first_pattern(lost), "token_lost");
  lost = words_;
  lost.erase(lost.begin(), lost.begin() + 7);
  EXPECT_EQ(first_pattern(lost), "tokens_lost");
  lost = words_;
  for (const std::size_t at : {900, 600, 300}) lost.erase(lost.begin() + static_cast<std::ptrdiff_t>(at));
  EXPECT_EQ(first_pattern(lost), "tokens_lost");
  EXPECT_EQ(compare(lost).patterns.front().text,
            "3 tokens are lost at 3 places, the first one token 300 (frame 0, row 7, column 20), all others "
            "are there");
  Words twice = words_;
  twice.insert(twice.begin() + 500, words_[499]);
  EXPECT_EQ(first_pattern(twice), "token_doubled");
  Words more = words_;
  more.insert(more.begin() + 500, 3, {77});
  EXPECT_EQ(first_pattern(more), "tokens_inserted");
  Words cut(words_.begin(), words_.begin() + 700);
  EXPECT_EQ(first_pattern(cut), "truncated");
  EXPECT_EQ(text(compare(cut)).substr(0, 65),
            "left_codes: 700 tokens in place of 1200, 500 too few\nleft_codes: ");
  Words longer = words_;
  longer.push_back({1});
  EXPECT_EQ(first_pattern(longer), "surplus");
  EXPECT_EQ(first_pattern({}), "truncated");
}

}  // namespace token_comparison_test
}  // namespace parallax
