// SPDX-License-Identifier: Apache-2.0
// How far simulated time reaches. Dates are picoseconds in 64 bits with a sign, and known ahead of the
// kernel's time by up to a frame.
#pragma once

#include <systemc>

namespace parallax {

class Machine;

/// The last date that the kernel goes to, s: 2^62 ps, 53.4 days.
constexpr double kLastSecond = 4611686.018427387904;
/// The longest that a part may take for a frame, s: 2^61 ps, 26.7 days.
constexpr double kLongestFrame = kLastSecond / 2;

/// What a frame takes at least, s: the time of the part that takes longest. Throws UserError when a part
/// takes longer than kLongestFrame, with the keys that its time follows from.
double shortest_frame_time(const Machine& machine);

/// Simulates what happens in the next `piece`, or the next thing that happens if that is later: time goes on
/// with each call. Throws UserError instead of going beyond kLastSecond.
void simulate_for(const sc_core::sc_time& piece);

}  // namespace parallax
