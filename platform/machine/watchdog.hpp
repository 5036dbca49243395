// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <systemc>

namespace parallax {

/// Ends a simulation in which nothing moves any more while other modules (a clock of the user's, say) keep
/// the kernel's time going, or in which the user's block or memory has stopped without a word:
/// SC_REPORT_ERROR /parallax/machine/hang.
class Watchdog final : public sc_core::sc_module {
 public:
  struct Watched {
    std::function<bool()> over;               ///< nothing is expected any more
    std::function<bool()> waits;              ///< for something that comes at a later date by itself
    std::function<sc_core::sc_time()> moved;  ///< date of the last movement that is known
    std::function<std::string(const sc_core::sc_time& since)> report;  ///< who holds it up
  };

  Watchdog(const sc_core::sc_module_name& name, Watched watched);

  /// From now on nothing may stand for `patience`, which is above 0.
  void start(const sc_core::sc_time& patience);

 private:
  void look();

  const Watched watched_;
  sc_core::sc_time patience_;
  sc_core::sc_time waited_until_;
  sc_core::sc_event again_;
};

}  // namespace parallax
