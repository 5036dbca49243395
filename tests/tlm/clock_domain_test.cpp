// SPDX-License-Identifier: Apache-2.0
#include "tlm/clock_domain.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tlm/error.hpp"

namespace parallax {
namespace clock_domain_test {

const std::vector<std::int64_t> kFrequencies{
    1, 3, 7, 32'768, 125'000'000, 171'999'997, 175'000'000, 533'333'333, 999'999'937, 1'000'000'000'000};
// The last one is where 171,999,997 Hz has run for nearly six seconds.
const std::vector<std::int64_t> kCycles{0, 1, 2, 3, 1000, 307'200, 999'999, 999'999'999, 1'000'000'000};

ClockDomain clock(std::int64_t hz) { return {"clock", Hertz(hz)}; }

TEST(ClockDomain, AnEdgesTimeLeadsBackToTheEdge) {
  for (const std::int64_t hz : kFrequencies) {
    for (const std::int64_t n : kCycles) {
      if (hz < 100 && n > 1'000'000) continue;  // beyond what kernel time holds
      const ClockDomain c = clock(hz);
      EXPECT_EQ(c.cycle_at_or_after(c.time_of(Cycles(n))).count(), n) << hz << " Hz";
    }
  }
}

TEST(ClockDomain, OnePicosecondLaterIsTheNextEdge) {
  for (const std::int64_t hz : kFrequencies) {
    if (hz > 100'000'000'000) continue;  // edges are not a picosecond apart
    for (const std::int64_t n : kCycles) {
      if (hz < 100 && n > 1'000'000) continue;
      const ClockDomain c = clock(hz);
      const sc_core::sc_time later = sc_core::sc_time::from_value(c.time_of(Cycles(n)).value() + 1);
      EXPECT_EQ(c.cycle_at_or_after(later).count(), n + 1) << hz << " Hz";
    }
  }
}

TEST(ClockDomain, TimeIsTheExactQuotientRoundedDown) {
  // 10^9 cycles of 171,999,997 Hz: 10^21 / 171999997 ps.
  EXPECT_EQ(clock(171'999'997).time_of(Cycles(1'000'000'000)).value(), 5'813'953'589'778u);
  EXPECT_EQ(clock(3).time_of(Cycles(1)).value(), 333'333'333'333u);
  EXPECT_EQ(clock(3).time_of(Cycles(3)).value(), 1'000'000'000'000u);
}

TEST(ClockDomain, NothingDriftsOverABillionCycles) {
  // At every multiple of the frequency a whole second has passed, exactly.
  const ClockDomain c = clock(171'999'997);
  for (std::int64_t s = 1; s <= 6; ++s) {
    EXPECT_EQ(c.time_of(Cycles(171'999'997 * s)), sc_core::sc_time(static_cast<double>(s), sc_core::SC_SEC));
  }
}

// The definition: the least m with m / f > n / g, by search from below.
std::int64_t naive_first_edge_after(std::int64_t f, std::int64_t g, std::int64_t n) {
  __extension__ using Wide = __int128;
  std::int64_t m = static_cast<std::int64_t>(static_cast<long double>(n) * static_cast<long double>(f) /
                                             static_cast<long double>(g));
  m = m > 3 ? m - 3 : 0;
  while (Wide{m} * g <= Wide{n} * f) ++m;
  return m;
}

TEST(ClockDomain, FirstEdgeAfterIsTheLeastLaterEdge) {
  for (const std::int64_t f : kFrequencies) {
    for (const std::int64_t g : kFrequencies) {
      const ClockDomain to = clock(f);
      const ClockDomain from = clock(g);
      for (const std::int64_t n : kCycles) {
        if (static_cast<long double>(n) * static_cast<long double>(f) / static_cast<long double>(g) > 1e18L) {
          continue;
        }
        EXPECT_EQ(to.first_edge_after(from, Cycles(n)).count(), naive_first_edge_after(f, g, n))
            << f << " Hz after edge " << n << " of " << g << " Hz";
      }
    }
  }
}

TEST(ClockDomain, SeveralHundredEdgesOneByOne) {
  const ClockDomain to = clock(175'000'000);
  const ClockDomain from = clock(533'333'333);
  for (std::int64_t n = 0; n < 2000; ++n) {
    ASSERT_EQ(to.first_edge_after(from, Cycles(n)).count(),
              naive_first_edge_after(175'000'000, 533'333'333, n));
  }
}

TEST(ClockDomain, SecondsOfCycles) { EXPECT_DOUBLE_EQ(clock(125'000'000).seconds(Cycles(125)), 1e-6); }

TEST(ClockDomain, RefusesFrequenciesThatAreNone) {
  for (const std::int64_t hz : {std::int64_t{0}, std::int64_t{-5}, std::int64_t{1'000'000'000'001}}) {
    try {
      clock(hz);
      FAIL() << hz;
    } catch (const UserError& e) {
      EXPECT_EQ(std::string(e.what()),
                "clock 'clock': frequency " + std::to_string(hz) + " Hz is outside 1 to 1000000000000 Hz");
    }
  }
}

}  // namespace clock_domain_test
}  // namespace parallax
