// SPDX-License-Identifier: Apache-2.0
#include "tlm/schedule.hpp"

namespace parallax {
namespace {

// Adds `count` to the entry of each port of the mask.
template <class Counts>
void add(PortMask ports, std::uint64_t count, Counts& counts) {
  for (unsigned mask = ports; mask != 0; mask &= mask - 1) counts[__builtin_ctz(mask)] += count;
}

}  // namespace

void Firings::lengthen(std::uint32_t cycles) {
  Phase last = phases_.back();
  if (--phases_.back().count == 0) phases_.pop_back();
  last.count = 1;
  last.interval += cycles;
  add(last);
}

Schedule& Schedule::repeat(std::uint64_t times, const std::vector<Phase>& phases) {
  const auto first = static_cast<std::uint32_t>(phases_.size());
  if (phases_.empty()) phases_.reserve(phases.size());  // most often, all there will be
  for (const Phase& phase : phases) {
    if (phase.count != 0) phases_.push_back(phase);
  }
  const auto count = static_cast<std::uint32_t>(phases_.size()) - first;
  if (times == 0 || count == 0) {
    phases_.resize(first);
    return *this;
  }
  for (std::uint32_t i = first; i < phases_.size(); ++i) {
    const Phase& phase = phases_[i];
    const std::uint64_t firings = times * phase.count;
    totals_.cycles += firings * phase.interval;
    add(phase.consume, firings, totals_.consumed);
    add(phase.produce, firings, totals_.produced);
  }
  if (times == 1 && !segments_.empty() && segments_.back().repeat == 1) {
    segments_.back().phase_count += count;
    return *this;
  }
  segments_.push_back({times, first, count});
  return *this;
}

}  // namespace parallax
