// SPDX-License-Identifier: Apache-2.0
#include "platform/version.hpp"

#include <gtest/gtest.h>

#include <regex>

namespace parallax {
namespace {

TEST(Version, NamesTheRelease) {
  EXPECT_TRUE(std::regex_match(version(), std::regex("[0-9]+\\.[0-9]+\\.[0-9]+"))) << version();
}

TEST(Version, NamesTheRevisionOrSaysThatItIsUnknown) {
  EXPECT_TRUE(std::regex_match(revision(), std::regex("unknown|[0-9a-f]{12,40}(-dirty)?"))) << revision();
}

}  // namespace
}  // namespace parallax
