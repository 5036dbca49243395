// SPDX-License-Identifier: Apache-2.0
#include "platform/results/version.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace parallax {
namespace version_test {

TEST(Version, NamesTheRelease) {
  const std::string text = version();
  EXPECT_EQ(text.find_first_not_of("0123456789."), std::string::npos) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '.'), 2) << text;
}

TEST(Version, NamesTheRevisionOrSaysThatItIsUnknown) {
  const std::string text = revision();
  const std::string hash = text.substr(0, text.find('-'));
  if (hash == "unknown") return;
  EXPECT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos) << text;
  EXPECT_GE(hash.size(), 12U) << text;
}

}  // namespace version_test
}  // namespace parallax
