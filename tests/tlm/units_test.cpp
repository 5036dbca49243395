// SPDX-License-Identifier: Apache-2.0
#include "tlm/units.hpp"

#include <gtest/gtest.h>

#include <type_traits>

namespace parallax {
namespace units_test {

template <class A, class B, class = void>
struct Adds : std::false_type {};
template <class A, class B>
struct Adds<A, B, std::void_t<decltype(std::declval<A>() + std::declval<B>())>> : std::true_type {};
template <class A, class B, class = void>
struct Compares : std::false_type {};
template <class A, class B>
struct Compares<A, B, std::void_t<decltype(std::declval<A>() < std::declval<B>())>> : std::true_type {};

static_assert(Adds<Cycles, Cycles>::value && Compares<Bits, Bits>::value);
static_assert(!Adds<Cycles, Bytes>::value, "cycles and bytes do not add");
static_assert(!Adds<Bits, Bytes>::value, "bits and bytes do not add");
static_assert(!Adds<Cycles, int>::value, "a bare number has no unit");
static_assert(!Compares<Cycles, Hertz>::value);
static_assert(!std::is_convertible_v<int, Cycles>);
static_assert(!std::is_constructible_v<Cycles, double>, "cycles are whole");
static_assert(sizeof(Cycles) == sizeof(std::int64_t));

TEST(Units, CountLikeIntegers) {
  Cycles c(7);
  c += Cycles(5);
  c -= Cycles(2);
  EXPECT_EQ(c.count(), 10);
  EXPECT_EQ((c + Cycles(1)).count(), 11);
  EXPECT_EQ((c - Cycles(11)).count(), -1);
  EXPECT_EQ((c * 3).count(), 30);
  EXPECT_TRUE(c == Cycles(10) && c != Cycles(9) && c > Cycles(9) && c >= Cycles(10) && c <= Cycles(10));
  EXPECT_EQ(Cycles().count(), 0);
}

}  // namespace units_test
}  // namespace parallax
