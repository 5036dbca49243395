// SPDX-License-Identifier: Apache-2.0
#include "tlm/clock_domain.hpp"

#include <fmt/format.h>

#include <utility>

#include "tlm/error.hpp"

namespace parallax {
namespace {

__extension__ using Wide = unsigned __int128;

constexpr std::int64_t kPicosecondsPerSecond = 1'000'000'000'000;

// a * b / c without overflow, rounded down.
std::uint64_t scale(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  return static_cast<std::uint64_t>(Wide{a} * b / c);
}

std::uint64_t unsigned_count(Cycles c) { return static_cast<std::uint64_t>(c.count()); }

}  // namespace

ClockDomain::ClockDomain(std::string name, Hertz frequency) : name_(std::move(name)), frequency_(frequency) {
  if (frequency < Hertz(1) || frequency > Hertz(kPicosecondsPerSecond)) {
    throw UserError(fmt::format("clock '{}': frequency {} Hz is outside 1 to {} Hz", name_, frequency.count(),
                                kPicosecondsPerSecond));
  }
}

sc_core::sc_time ClockDomain::time_of(Cycles cycle) const {
  const auto hz = static_cast<std::uint64_t>(frequency_.count());
  return sc_core::sc_time::from_value(scale(unsigned_count(cycle), kPicosecondsPerSecond, hz));
}

Cycles ClockDomain::cycle_at_or_after(const sc_core::sc_time& time) const {
  // The estimate from the rounded time is at most one edge early.
  const auto hz = static_cast<std::uint64_t>(frequency_.count());
  Cycles cycle(scale(time.value(), hz, kPicosecondsPerSecond));
  while (time_of(cycle) < time) cycle += Cycles(1);
  return cycle;
}

Cycles ClockDomain::now() const { return cycle_at_or_after(sc_core::sc_time_stamp()); }

Cycles ClockDomain::first_edge_after(const ClockDomain& other, Cycles cycle) const {
  if (frequency_ == other.frequency_) return cycle + Cycles(1);
  return Cycles(scale(unsigned_count(cycle), static_cast<std::uint64_t>(frequency_.count()),
                      static_cast<std::uint64_t>(other.frequency_.count())) +
                1);
}

double ClockDomain::seconds(Cycles cycles) const {
  return static_cast<double>(cycles.count()) / static_cast<double>(frequency_.count());
}

void ClockDomain::wait_until(Cycles cycle) const {
  const sc_core::sc_time target = time_of(cycle);
  const sc_core::sc_time& present = sc_core::sc_time_stamp();
  if (target > present) sc_core::wait(target - present);
}

}  // namespace parallax
