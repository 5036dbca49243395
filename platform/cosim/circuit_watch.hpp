// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

#include "platform/cosim/circuit_library.hpp"
#include "tlm/units.hpp"

namespace parallax {

/// Ends the process, with one line and the code of a circuit that is given up, when the circuit does not come
/// back from an evaluation, as with an endless loop in an always block: nothing else in the process can go on
/// then. A thread looks once a second; for the circuit that costs two additions an evaluation.
class CircuitWatch {
 public:
  /// `where`: what is said of the circuit. `seconds`: how long an evaluation may take, >= 1. The circuit must
  /// outlive it.
  CircuitWatch(const Circuit& circuit, std::string where, std::uint64_t seconds);
  ~CircuitWatch();
  CircuitWatch(const CircuitWatch&) = delete;
  CircuitWatch& operator=(const CircuitWatch&) = delete;

  /// The cycle that is evaluated from now on; before the first one it is in reset.
  void at(Cycles cycle) { cycle_.store(cycle.count(), std::memory_order_relaxed); }

 private:
  void look();
  [[noreturn]] void end() const;

  const Circuit& circuit_;
  const std::string where_;
  const std::uint64_t seconds_;
  std::atomic<std::int64_t> cycle_{-1};
  std::mutex mutex_;
  std::condition_variable over_;
  bool is_over_ = false;
  std::thread thread_;
};

}  // namespace parallax
