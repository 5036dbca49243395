// SPDX-License-Identifier: Apache-2.0
#include "tlm/ratio.hpp"

#include <gtest/gtest.h>

#include <random>

namespace parallax {
namespace ratio_test {

__extension__ using Wide = unsigned __int128;

struct Fraction {
  std::uint64_t numerator, denominator;
};

// By division; false when the result needs more than 64 bits.
bool by_division(const Fraction& f, std::uint64_t value, std::uint64_t& floor, std::uint64_t& ceil) {
  const Wide product = Wide{value} * f.numerator;
  const Wide quotient = product / f.denominator;
  if (quotient >= ~std::uint64_t{0}) return false;
  floor = static_cast<std::uint64_t>(quotient);
  ceil = floor + (product % f.denominator == 0 ? 0 : 1);
  return true;
}

void check(const Fraction& f, std::uint64_t value) {
  const Ratio ratio(f.numerator, f.denominator);
  std::uint64_t floor = 0;
  std::uint64_t ceil = 0;
  if (!by_division(f, value, floor, ceil)) return;
  ASSERT_EQ(ratio.floor(value), floor) << value << " * " << f.numerator << " / " << f.denominator;
  ASSERT_EQ(ratio.ceil(value), ceil) << value << " * " << f.numerator << " / " << f.denominator;
}

TEST(Ratio, IsExactForClocks) {
  std::mt19937_64 random(1);
  constexpr std::uint64_t kPicoseconds = 1'000'000'000'000;
  for (const std::uint64_t hz : {1ull, 3ull, 32'768ull, 80'000'000ull, 125'000'000ull, 171'999'997ull,
                                 533'333'333ull, 999'999'999'989ull, 1'000'000'000'000ull}) {
    for (int i = 0; i < 20'000; ++i) {
      const std::uint64_t value = random() >> (1 + random() % 63);
      check({kPicoseconds, hz}, value);
      check({hz, kPicoseconds}, value);
      // Where the result is whole, and next to it: the quotients that rounding gets wrong.
      const std::uint64_t whole = value / kPicoseconds * kPicoseconds;
      for (const std::uint64_t near : {whole - 1, whole, whole + 1}) {
        if (near < (1ull << 63)) check({hz, kPicoseconds}, near);
      }
    }
  }
}

TEST(Ratio, IsExactForAnyFraction) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 300'000; ++i) {
    const Fraction f{1 + (random() >> (1 + random() % 62)), 1 + (random() >> (1 + random() % 62))};
    const std::uint64_t value = random() >> (1 + random() % 63);
    check(f, value);
    check(f, value / f.denominator * f.denominator);
  }
}

TEST(Ratio, IsExactAtTheEndsOfItsRange) {
  const std::uint64_t most = (1ull << 63) - 1;
  for (const Fraction f :
       {Fraction{1, 1}, Fraction{1, most}, Fraction{most, most}, Fraction{most - 1, most}}) {
    for (const std::uint64_t value : {std::uint64_t{0}, std::uint64_t{1}, most - 1, most}) check(f, value);
  }
}

}  // namespace ratio_test
}  // namespace parallax
