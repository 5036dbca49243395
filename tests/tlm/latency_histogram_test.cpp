// SPDX-License-Identifier: Apache-2.0
#include "tlm/latency_histogram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace parallax::test {
namespace latency_histogram_test {

sc_core::sc_time ps(std::uint64_t count) { return sc_core::sc_time::from_value(count); }

TEST(LatencyHistogram, IsZeroWhenEmpty) {
  const LatencyHistogram histogram;
  EXPECT_EQ(histogram.mean(), sc_core::SC_ZERO_TIME);
  EXPECT_EQ(histogram.percentile(0.5), sc_core::SC_ZERO_TIME);
  EXPECT_EQ(histogram.largest(), sc_core::SC_ZERO_TIME);
}

TEST(LatencyHistogram, OneValueIsAllPercentiles) {
  for (const std::uint64_t value : {0ull, 1ull, 63ull, 64ull, 12345ull, 1ull << 40, (1ull << 62) + 5}) {
    LatencyHistogram histogram;
    histogram.add(ps(value));
    for (const double share : {0.0, 0.5, 1.0}) EXPECT_EQ(histogram.percentile(share), ps(value));
  }
}

// Against sorted values, at most 1/64 above.
TEST(LatencyHistogram, PercentilesAreThoseOfTheSortedValues) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 50; ++round) {
    LatencyHistogram histogram;
    std::vector<std::uint64_t> values;
    sc_core::sc_time sum;
    for (int i = 0; i < 1000; ++i) {
      values.push_back(random() >> (20 + random() % 40));
      histogram.add(ps(values.back()));
    }
    std::sort(values.begin(), values.end());
    for (const std::uint64_t value : values) sum += ps(value);
    EXPECT_EQ(histogram.sum(), sum);
    EXPECT_EQ(histogram.largest(), ps(values.back()));
    EXPECT_EQ(histogram.count(), 1000u);
    for (const double share : {0.01, 0.5, 0.95, 0.99, 1.0}) {
      const std::uint64_t exact = values[static_cast<std::size_t>(share * 1000 + 0.5) - 1];
      EXPECT_GE(histogram.percentile(share).value(), exact);
      EXPECT_LE(histogram.percentile(share).value(), exact + exact / 64 + 1);
    }
  }
}

}  // namespace latency_histogram_test
}  // namespace parallax::test
