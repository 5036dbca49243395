// SPDX-License-Identifier: Apache-2.0
#include "platform/input/nesting_depth.hpp"

#include <gtest/gtest.h>

namespace parallax {
namespace nesting_depth_test {

TEST(NestingDepth, CountsBracketsOutsideQuotes) {
  EXPECT_EQ(nesting_depth(""), 0U);
  EXPECT_EQ(nesting_depth("a: 1"), 0U);
  EXPECT_EQ(nesting_depth("{\"a\": [1, [2]], \"b\": [3]}"), 3U);
  EXPECT_EQ(nesting_depth("a: \"[[[\\\"[[\" b: '{{' [1]"), 1U);
  EXPECT_EQ(nesting_depth("]]]] [1]"), 1U);
  EXPECT_EQ(nesting_depth("a: [\n[\n["), 3U);
}

TEST(NestingDepth, CountsTheBlanksBeforeALine) {
  EXPECT_EQ(nesting_depth("a:\n  b:\n     c: 1\n"), 5U);
  EXPECT_EQ(nesting_depth("a:\n          \nb: 1"), 0U) << "a line of blanks is none";
}

TEST(NestingDepth, CountsElements) {
  EXPECT_EQ(nesting_depth("<?xml version=\"1.0\"?>\n<a><b/><c><d>[[[[</d></c><!-- <x -->\n</a>"), 3U);
  EXPECT_EQ(nesting_depth("\n <a></a></a></a><b>"), 1U);
}

}  // namespace nesting_depth_test
}  // namespace parallax
