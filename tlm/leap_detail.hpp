// SPDX-License-Identifier: Apache-2.0
// What the parts of Leap share.
#pragma once

#include <cstdint>
#include <limits>

#include "tlm/leap_history.hpp"
#include "tlm/schedule.hpp"

namespace parallax::leap_detail {

constexpr std::uint64_t kLargestUnit = kLeapHistory;  // firings of a unit, and of a period
constexpr std::uint64_t kAlways = std::numeric_limits<std::uint64_t>::max();

inline std::int64_t as_signed(std::uint64_t count) { return static_cast<std::int64_t>(count); }
inline PortMask mask(unsigned ports) { return static_cast<PortMask>(ports); }
inline PortMask without(PortMask ports, PortMask core) { return mask(ports & ~unsigned{core}); }
inline PortMask within(PortMask ports, PortMask core) { return mask(unsigned{ports} & core); }
inline bool contains(PortMask mask, PortMask port) { return (mask & port) != 0; }

// Whether two phases do the same to the core ports, and count as the same kind of time.
inline bool same_in(const Phase& a, const Phase& b, PortMask in, PortMask out) {
  return a.interval == b.interval && a.idle == b.idle && within(a.consume, in) == within(b.consume, in) &&
         within(a.produce, out) == within(b.produce, out);
}

}  // namespace parallax::leap_detail
