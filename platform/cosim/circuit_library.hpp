// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "platform/cosim/circuit/circuit.h"

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
  const std::vector<parallax_pin>& pins() const { return pins_; }
  void evaluate() { entry_->evaluate(circuit_); }
  bool finished() const { return entry_->finished(circuit_) != 0; }

 private:
  void* library_ = nullptr;
  const parallax_circuit* entry_ = nullptr;
  void* circuit_ = nullptr;
  std::vector<parallax_pin> pins_;
};

/// Bytes that the simulator keeps a pin in: an integer, or words of 32 bits.
std::size_t pin_bytes(const parallax_pin& pin);
/// Writes an input pin of at most 64 bits.
void set_pin(const parallax_pin& pin, std::uint64_t value);
/// Writes words of 64 bits, bit 0 lowest in the first one, of the pin's width.
void set_pin(const parallax_pin& pin, const std::vector<std::uint64_t>& words);
/// Whether a pin of at most 64 bits is not 0.
bool is_set(const parallax_pin& pin);
/// Reads words as set_pin() writes them.
void read_pin(const parallax_pin& pin, std::vector<std::uint64_t>& words);

}  // namespace parallax
