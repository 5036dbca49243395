// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/watchdog.hpp"

#include <algorithm>
#include <utility>

namespace parallax {

Watchdog::Watchdog(const sc_core::sc_module_name& name, Watched watched)
    : sc_module(name), watched_(std::move(watched)) {
  SC_HAS_PROCESS(Watchdog);
  SC_METHOD(look);
  sensitive << again_;
  dont_initialize();
}

void Watchdog::start(const sc_core::sc_time& patience) {
  patience_ = patience;
  again_.notify(patience_);
}

void Watchdog::look() {
  if (watched_.over()) return;
  const sc_core::sc_time& now = sc_core::sc_time_stamp();
  if (watched_.waits()) waited_until_ = now;
  const sc_core::sc_time since = std::max(waited_until_, watched_.moved());
  if (now <= since + patience_) {  // what comes at this very date may still come
    again_.notify(since + patience_ + sc_core::sc_get_time_resolution() - now);
    return;
  }
  SC_REPORT_ERROR("/parallax/machine/hang", watched_.report(since).c_str());
}

}  // namespace parallax
