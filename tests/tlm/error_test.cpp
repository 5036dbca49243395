// SPDX-License-Identifier: Apache-2.0
#include "tlm/error.hpp"

#include <gtest/gtest.h>

namespace parallax {
namespace error_test {

TEST(Excerpt, QuotesSoMuchAndNoMore) {
  EXPECT_EQ(excerpt(""), "");
  EXPECT_EQ(excerpt("abc", 3), "abc");
  EXPECT_EQ(excerpt("abcd", 3), "abc...");
  EXPECT_EQ(excerpt(std::string(1'000'000, 'x')), std::string(60, 'x') + "...");
}

TEST(Excerpt, IsOneLineThatATerminalShows) { EXPECT_EQ(excerpt("a\nb\r\tc\x1B[2J\x7F"), "a b  c [2J "); }

TEST(Excerpt, CutsNoCharacterInTwo) {
  EXPECT_EQ(excerpt("a\xC3\xA4z", 2), "a...");
  EXPECT_EQ(excerpt("a\xC3\xA4z", 3), "a\xC3\xA4...");
  EXPECT_EQ(excerpt("\xE2\x82\xAC\xE2\x82\xAC", 5), "\xE2\x82\xAC...");
  EXPECT_EQ(excerpt("\x80\x80\x80", 2), "...") << "what is no UTF-8 at all";
}

}  // namespace error_test
}  // namespace parallax
