// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/expression.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "tests/platform/error_of.hpp"

namespace parallax::test {
namespace expression_test {

const std::vector<std::string> kNames{"matching.parallelism", "clocks.core_hz", "size"};
const std::vector<ConfigValue> kValues{std::int64_t{32}, 150e6, std::string("640x480")};

ConfigValue value(const std::string& text) { return Expression(text, kNames, "spec:3").value(kValues); }

TEST(Expression, Computes) {
  EXPECT_EQ(value("128 / matching.parallelism"), ConfigValue(std::int64_t{4}));
  EXPECT_EQ(value("100 / matching.parallelism"), ConfigValue(std::int64_t{3}));
  EXPECT_EQ(value("clocks.core_hz * 2"), ConfigValue(300e6));
  EXPECT_EQ(value("1.5e-3 * 2"), ConfigValue(3e-3));
  EXPECT_EQ(value("max(matching.parallelism, 64) - 1"), ConfigValue(std::int64_t{63}));
  EXPECT_EQ(value("case when size = '640x480' then 8 else 4 end"), ConfigValue(std::int64_t{8}));
  EXPECT_EQ(value("size"), ConfigValue(std::string("640x480")));
}

TEST(Expression, SaysWhetherItHolds) {
  const auto holds = [](const std::string& text) {
    return Expression(text, kNames, "spec:3").holds(kValues);
  };
  EXPECT_TRUE(holds("matching.parallelism in (16, 32) and not clocks.core_hz > 200e6"));
  EXPECT_TRUE(holds("clocks.core_hz between 100e6 and 150e6"));
  EXPECT_FALSE(holds("matching.parallelism == 16"));
  EXPECT_FALSE(holds("matching.parallelism / 0"));
}

struct Wrong {
  const char* text;
  const char* line;
};

void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.text; }

class WrongExpression : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongExpression, IsOneLine) {
  EXPECT_EQ(error_of([] { value(GetParam().text); }), GetParam().line);
}

INSTANTIATE_TEST_SUITE_P(
    Of, WrongExpression,
    ::testing::Values(
        Wrong{
            "matching.paralelism * 2",
            "spec:3: 'matching.paralelism * 2': matching.paralelism is neither varied nor linked before; the "
            "nearest is matching.parallelism"},
        Wrong{"1 +", "spec:3: '1 +': near \")\": syntax error"},
        Wrong{"sum_of(3)", "spec:3: 'sum_of(3)': sum_of() is no function here"},
        Wrong{"random() > 0", "spec:3: 'random() > 0': random() is no function here"},
        Wrong{"1) or (1", "spec:3: '1) or (1': a parenthesis is closed that is not open"},
        Wrong{"1; drop table x", "spec:3: '1; drop table x': ';' has no place here"},
        Wrong{"1 -- 2", "spec:3: '1 -- 2': it has no comments"},
        Wrong{"\"size\"", "spec:3: '\"size\"': '\"' has no place here"},
        Wrong{"'abc", "spec:3: ''abc': a quote is not closed"},
        Wrong{"1 / 0", "spec:3: '1 / 0' has no value"}));

}  // namespace expression_test
}  // namespace parallax::test
