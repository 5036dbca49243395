// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "platform/cosim/circuit/circuit.h"
#include "platform/cosim/pin_list.hpp"

namespace parallax {

/// A circuit behind the C interface of circuit.h, in this process.
class Circuit {
 public:
  /// Loads the library, makes a circuit of it; `seed`: of what it has no initial value for. Throws UserError
  /// when it cannot be loaded, is no circuit or one of another version.
  Circuit(const std::filesystem::path& library, unsigned seed);
  ~Circuit();
  Circuit(const Circuit&) = delete;
  Circuit& operator=(const Circuit&) = delete;

  const char* name() const { return entry_->name; }  ///< of its top module, or of its file
  const std::vector<parallax_pin>& pins() const { return list_.pins; }
  const PinList& list() const { return list_; }
  void evaluate() {
    count_call();
    entry_->evaluate(circuit_);
    count_call();
  }
  /// How often evaluate() was entered and left: odd within. For other threads, too.
  std::uint64_t calls() const { return calls_.load(std::memory_order_relaxed); }
  bool finished() const { return entry_->finished(circuit_) != 0; }

 private:
  // One thread alone counts.
  void count_call() { calls_.store(calls() + 1, std::memory_order_relaxed); }

  std::atomic<std::uint64_t> calls_{0};
  void* library_ = nullptr;
  const parallax_circuit* entry_ = nullptr;
  void* circuit_ = nullptr;
  PinList list_;
};

}  // namespace parallax
