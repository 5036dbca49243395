// SPDX-License-Identifier: Apache-2.0
#include "platform/input/nesting_depth.hpp"

#include <gtest/gtest.h>

namespace parallax {
namespace nesting_depth_test {

TEST(NestingDepth, CountsBrackets) {
  EXPECT_EQ(nesting_depth(""), 0U);
  EXPECT_EQ(nesting_depth("{\"a\": [1, [2]], \"b\": [3]}"), 3U);
  EXPECT_EQ(nesting_depth("{\"a\": \"]]]\\\"]]\", \"b\": '}}', \"c\": [1]}"), 2U) << "quotes do not close";
  EXPECT_EQ(nesting_depth("{\"a\": \"[[[\"}"), 4U) << "but might be none";
  EXPECT_EQ(nesting_depth("{]]]} [1]"), 1U);
  EXPECT_EQ(nesting_depth("{\n[\n["), 3U);
}

TEST(NestingDepth, CountsElements) {
  EXPECT_EQ(nesting_depth("<?xml version=\"1.0\"?>\n<a><b/><c><d>[[[[</d></c><!-- <x -->\n</a>"), 3U);
  EXPECT_EQ(nesting_depth("\n <a></a></a></a><b>"), 1U);
  EXPECT_EQ(nesting_depth("<a><!--</a>--><b><!--</b>--><c x=\"</c>\" y='/>'>"), 3U);
}

}  // namespace nesting_depth_test
}  // namespace parallax
