// SPDX-License-Identifier: Apache-2.0
#include "traces/sampling_timer.hpp"

#include <algorithm>

namespace parallax {

SamplingTimer::SamplingTimer(const sc_core::sc_module_name& name) : sc_module(name) {
  SC_HAS_PROCESS(SamplingTimer);
  SC_METHOD(go_on);
}

void SamplingTimer::go_on() {
  const sc_core::sc_time& now = sc_core::sc_time_stamp();
  sc_core::sc_time next = sc_core::sc_max_time();
  for (Look& look : looks_) {
    if (look.next <= now) {
      look.look();
      look.next = now + look.period;
    }
    next = std::min(next, look.next);
  }
  if (!looks_.empty() && sc_core::sc_pending_activity()) next_trigger(next - now);
}

}  // namespace parallax
