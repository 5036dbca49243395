// SPDX-License-Identifier: Apache-2.0
#include "tlm/schedule.hpp"

namespace parallax {

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
  if (times == 1 && !segments_.empty() && segments_.back().repeat == 1) {
    segments_.back().phase_count += count;
    return *this;
  }
  segments_.push_back({times, first, count});
  return *this;
}

template <class Weight>
std::uint64_t Schedule::sum(Weight weight) const {
  std::uint64_t total = 0;
  for (const Segment& segment : segments_) {
    std::uint64_t once = 0;
    for (std::uint32_t i = 0; i < segment.phase_count; ++i) {
      const Phase& phase = phases_[segment.first_phase + i];
      once += weight(phase) * phase.count;
    }
    total += once * segment.repeat;
  }
  return total;
}

std::uint64_t Schedule::cycles() const {
  return sum([](const Phase& p) { return std::uint64_t{p.interval}; });
}

std::uint64_t Schedule::produced(unsigned port) const {
  return sum([port](const Phase& p) { return std::uint64_t{(p.produce >> port) & 1u}; });
}

std::uint64_t Schedule::consumed(unsigned port) const {
  return sum([port](const Phase& p) { return std::uint64_t{(p.consume >> port) & 1u}; });
}

}  // namespace parallax
