// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "platform/cosim/circuit/circuit.h"

namespace parallax {

/// Bits of a circuit's pin that lie beside each other: all of it, or a part, as tdata[15:8].
class PinBits {
 public:
  /// None.
  PinBits() = default;
  /// All of the pin.
  explicit PinBits(const parallax_pin& pin) : PinBits(pin, 0, pin.width) {}
  /// Needs bits that the pin has.
  PinBits(const parallax_pin& pin, std::size_t low, std::size_t width);

  /// Whether there are any.
  explicit operator bool() const { return pin_ != nullptr; }
  bool operator==(const PinBits& other) const {
    return pin_ == other.pin_ && low_ == other.low_ && width_ == other.width_;
  }
  const parallax_pin& pin() const { return *pin_; }
  /// "tdata", "tdata[15:8]"
  std::string name() const;
  std::size_t low() const { return low_; }
  std::size_t width() const { return width_; }

  // Of an input. The pin's other bits stay.

  /// Bits above the width are dropped.
  void set(std::uint64_t value) const;
  /// Words of 64 bits, bit 0 lowest in the first one; missing ones are 0.
  void set(const std::vector<std::uint64_t>& words) const;

  // Of an output.

  /// Whether one is 1.
  bool any() const;
  /// As set() takes them.
  void read(std::vector<std::uint64_t>& words) const;

 private:
  bool whole_word() const { return bytes_ > 0; }
  void put(std::size_t at, std::size_t bits, std::uint64_t value) const;
  std::uint64_t get(std::size_t at, std::size_t bits) const;

  const parallax_pin* pin_ = nullptr;
  std::size_t low_ = 0;
  std::size_t width_ = 0;
  std::size_t bytes_ = 0;  // of a pin that is an integer, all of whose bits are meant; else 0
  std::uint64_t mask_ = 0;
};

/// Bytes that a pin's value takes.
std::size_t pin_bytes(const parallax_pin& pin);

}  // namespace parallax
