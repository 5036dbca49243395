// SPDX-License-Identifier: Apache-2.0
// One rule of rounding: no digit that says something is lost to 0 or to 100.
#include "traces/number_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "tests/traces/naive_number_text.hpp"
#include "traces/metric_text.hpp"

namespace parallax::test {
namespace number_text_test {

struct Row {
  double value;
  const char* unit;
  const char* text;
};

// Worked out by hand.
TEST(NumberText, HasTheDecimalsOfItsUnitAndThreeDigitsAtLeast) {
  for (const Row& row : {Row{100.2604, "frames/s", "100.26"},
                         {0.61378, "frames/s", "0.614"},
                         {0.00012345, "frames/s", "0.000123"},
                         {0.000012345, "frames/s", "1.23e-05"},
                         {3968, "MB/s", "3968.0"},
                         {0.01896, "MB/s", "0.0190"},
                         {72.48, "%", "72.5"},
                         {7.2, "%", "7.2"},
                         {7.2041, "%", "7.20"},
                         {9.996, "%", "10.0"},
                         {0.717, "%", "0.717"},
                         {6324.3994, "ms", "6324.399"},
                         {1628943.4, "ms", "1628943"},
                         {12345678.9, "ms", "12345679"},
                         {999999999999.0, "ms", "999999999999"},
                         {1.5e12, "ms", "1.50e+12"},
                         {90.62, "ns", "90.6"},
                         {154.3, "ns", "154"},
                         {305406, "B", "305406"},
                         {305406.25, "B", "305406.2"},
                         {0.497, "B", "0.497"},
                         {0, "tokens", "0"},
                         {1856, "px", "1856"},
                         {0.4901, "px", "0.490"},
                         {71.28, "tokens", "71.3"},
                         {-4.694, "%", "-4.69"}})
    EXPECT_EQ(number_text(row.value, row.unit), row.text) << row.value << ' ' << row.unit;
}

TEST(NumberText, ZeroAndAHundredPercentAreExact) {
  for (const Row& row : {Row{0, "%", "0.0"},
                         {-0.0, "%", "0.0"},
                         {0.04, "%", "0.04"},
                         {1e-7, "%", "1.00e-07"},
                         {100, "%", "100.0"},
                         {99.7, "%", "99.7"},
                         {99.94, "%", "99.9"},
                         {99.96, "%", "99.96"},
                         {99.9996, "%", "99.9996"},
                         {100 - 1e-12, "%", "100.0"},
                         {100.04, "%", "100.0"},
                         {99.999, "MB/s", "100.0"}})
    EXPECT_EQ(number_text(row.value, row.unit), row.text) << row.value << ' ' << row.unit;
}

TEST(NumberText, OfSomethingASecondIsInLargePieces) {
  EXPECT_EQ(number_text(3.942399e9, "1/s"), "3.942 billion");
  EXPECT_EQ(number_text(30.8e6, "1/s"), "30.800 million");
  EXPECT_EQ(number_text(1885.4, "1/s"), "1.885 thousand");
  EXPECT_EQ(number_text(0.25, "1/s"), "0.250");
  EXPECT_EQ(stated_text(5.1e9, "1/s"), "5.1 billion");
  EXPECT_EQ(stated_text(55.296, "ms"), "55.296");
}

TEST(NumberText, WhatIsNoNumberSaysSo) {
  EXPECT_EQ(number_text(std::numeric_limits<double>::infinity(), "frames/s"), "inf");
  EXPECT_EQ(number_text(std::nan(""), "%"), "nan");
}

TEST(NumberText, AChangeHasItsSign) {
  EXPECT_EQ(change_text(4.694, "%"), "+4.69");
  EXPECT_EQ(change_text(-38.76, "%"), "-38.8");
  EXPECT_EQ(change_text(0, "%"), "0.0");
}

TEST(NumberText, UnitsAndThousands) {
  EXPECT_EQ(quantity_text(100.2604, "frames/s"), "100.26 fps");
  EXPECT_EQ(quantity_text(0.5, ""), "0.5000");
  EXPECT_EQ(quantity_text(3.942399e9, "1/s"), "3.942 billion/s");
  EXPECT_EQ(grouped("1228800"), "1,228,800");
  EXPECT_EQ(grouped("-436906.7 MB/s"), "-436,906.7 MB/s");
  EXPECT_EQ(grouped("999"), "999");
  EXPECT_EQ(grouped("nan"), "nan");
}

TEST(NumberText, EqualsTheNaiveOneOverAllMagnitudes) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-9, 14), part(0, 100);
  for (int i = 0; i < 2000; ++i) {
    for (const char* unit : {"%", "frames/s", "ms", "ns", "MB/s", "W", "cycles", "px", "1/s", ""}) {
      const double any = std::pow(10, exponent(random));
      EXPECT_EQ(number_text(any, unit), naive_number_text(any, unit)) << any << ' ' << unit;
      const double tenths = std::round(part(random) * 10) / 10;
      EXPECT_EQ(number_text(tenths, unit), naive_number_text(tenths, unit)) << tenths << ' ' << unit;
      const double nearly = 100 - std::pow(10, exponent(random));
      EXPECT_EQ(number_text(nearly, unit), naive_number_text(nearly, unit)) << nearly << ' ' << unit;
    }
  }
}

TEST(MetricText, SaysTheUnitAndLeavesCountsAndWords) {
  MetricGroup tree;
  tree.group("limit").metrics = {{"part", std::string("core"), "", "A word.", ""},
                                 {"utilisation", 99.97, "%", "A share.", ""},
                                 {"frames", std::int64_t{1'234'567'890'123}, "frames", "A count.", ""}};
  EXPECT_EQ(filled_in(tree, "{limit/part} at {limit/utilisation} of {limit/frames}."),
            "core at 99.97 % of 1234567890123 frames.");
  EXPECT_THROW(filled_in(tree, "{limit/none}"), MetricError);
  EXPECT_EQ(end_of_way(tree), "results in memory");
  tree.group("buffers").group("output");
  EXPECT_EQ(end_of_way(tree), "the host");
}

}  // namespace number_text_test
}  // namespace parallax::test
