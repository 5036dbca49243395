// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/value_range.hpp"

#include <gtest/gtest.h>

#include "tests/platform/error_of.hpp"

namespace parallax::test {
namespace value_range_test {

using Texts = std::vector<std::string>;

Texts values(const std::string& range) { return range_values(range, 1000); }

TEST(ValueRange, GoesFromStartToStopInSteps) {
  EXPECT_EQ(values("10:30:10"), Texts({"10", "20", "30"}));
  EXPECT_EQ(values("30:10:-10"), Texts({"30", "20", "10"}));
  EXPECT_EQ(values("-1:1:1"), Texts({"-1", "0", "1"}));
  EXPECT_EQ(values("5:5:1"), Texts({"5"}));
  EXPECT_EQ(values("5:5:-1"), Texts({"5"}));
}

TEST(ValueRange, EndsBeforeAStopThatNoStepMeets) {
  EXPECT_EQ(values("10:29:10"), Texts({"10", "20"}));
  EXPECT_EQ(values("10:11:5"), Texts({"10"}));
  EXPECT_EQ(values("1:0.25:-0.5"), Texts({"1.00", "0.50"}));
}

// In binary 0.1 + 0.2 is no 0.3, and ten steps of 0.1 do not meet 1.
TEST(ValueRange, StepsInDecimalWithoutDrift) {
  EXPECT_EQ(values("0:1:0.1"),
            Texts({"0.0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9", "1.0"}));
  const Texts many = values("-50:49.9:0.1");
  ASSERT_EQ(many.size(), 1000U);
  EXPECT_EQ(many[499], "-0.1");
  EXPECT_EQ(many[500], "0.0");
  EXPECT_EQ(many[999], "49.9");
}

TEST(ValueRange, KeepsPowersOfTenWhereAllThreeHaveTheSame) {
  EXPECT_EQ(values("125e6:175e6:25e6"), Texts({"125e6", "150e6", "175e6"}));
  EXPECT_EQ(values("1.5E-3:2.5E-3:.5E-3"), Texts({"1.5e-3", "2.0e-3", "2.5e-3"}));
  EXPECT_EQ(values("1e6:3000000:1000000"), Texts({"1000000", "2000000", "3000000"}));
  EXPECT_EQ(values("1e7:3e7:10e6"), Texts({"10e6", "20e6", "30e6"}));
  EXPECT_EQ(values("1e-3:3e-3:0.001"), Texts({"0.001", "0.002", "0.003"}));
}

TEST(ValueRange, SaysWhatIsWrong) {
  const auto error = [](const std::string& range) { return error_of([&] { values(range); }); };
  for (const std::string text :
       {"1:5", "1:5:1:1", ":5:1", "1::1", "1:5:", "1:5:x", "1:5 :1", "1:5:1e", "1:5:+", "a:b:c", "1:5:1.1.1",
        "nan:5:1", "1:inf:1", "0x1:5:1", "1e9999:2:1", "123456789012345678:2:1"}) {
    EXPECT_EQ(error(text), "'" + text +
                               "' is no range: it must have the form start:stop:step, three numbers such as "
                               "10:100:5");
  }
  EXPECT_EQ(error("1:5:0"), "the step of '1:5:0' is 0");
  EXPECT_EQ(error("1:5:0e3"), "the step of '1:5:0e3' is 0");
  EXPECT_EQ(error("1:5:-1"), "'1:5:-1' never comes to its end: the step must be positive");
  EXPECT_EQ(error("5:1:1"), "'5:1:1' never comes to its end: the step must be negative");
  EXPECT_EQ(error("1:1001:1"), "'1:1001:1' has more than 1000 values");
  EXPECT_EQ(values("1:1000:1").size(), 1000U);
  EXPECT_EQ(error("1:1e300:1"), "the numbers of '1:1e300:1' differ by too many digits");
}

}  // namespace value_range_test
}  // namespace parallax::test
