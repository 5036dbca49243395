// SPDX-License-Identifier: Apache-2.0
#include "tlm/clock_domain.hpp"

#include <fmt/format.h>

#include <utility>

#include "tlm/error.hpp"
#include "tlm/time_resolution.hpp"

namespace parallax {
namespace {

constexpr std::int64_t kPicosecondsPerSecond = 1'000'000'000'000;

Hertz checked(const std::string& name, Hertz frequency) {
  require_picosecond_resolution();
  if (frequency < Hertz(1) || frequency > Hertz(kPicosecondsPerSecond)) {
    throw UserError(fmt::format("clock '{}': frequency {} Hz is outside 1 to {} Hz", name, frequency.count(),
                                kPicosecondsPerSecond));
  }
  return frequency;
}

}  // namespace

ClockDomain::ClockDomain(std::string name, Hertz frequency)
    : name_(std::move(name)),
      frequency_(checked(name_, frequency)),
      period_(kPicosecondsPerSecond, frequency.size()),
      rate_(frequency.size(), kPicosecondsPerSecond) {}

Cycles ClockDomain::first_edge_after(const ClockDomain& other, Cycles cycle) const {
  if (frequency_ == other.frequency_) return cycle + Cycles(1);
  const std::uint64_t to = frequency_.size();
  const std::uint64_t from = other.frequency_.size();
  std::uint64_t product = 0;
  if (!__builtin_mul_overflow(cycle.size(), to, &product)) return Cycles(product / from + 1);
  return Cycles(Ratio(to, from).floor(cycle.size()) + 1);
}

double ClockDomain::seconds(Cycles cycles) const { return cycles.real() / frequency_.real(); }

void ClockDomain::wait_until(Cycles cycle) const {
  const sc_core::sc_time target = time_of(cycle);
  const sc_core::sc_time& present = sc_core::sc_time_stamp();
  if (target > present) sc_core::wait(target - present);
}

}  // namespace parallax
