// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "platform/cosim/circuit_library.hpp"
#include "platform/cosim/circuit_pins.hpp"
#include "platform/cosim/circuit_port.hpp"
#include "platform/cosim/pin_waves.hpp"
#include "tlm/clock_domain.hpp"

namespace parallax {

/// The pins of a circuit in the cycles around one in which something happened. Of a time in which nothing
/// moves only those cycles are kept that come first, or in which an output changes: of a circuit that hangs
/// those are there in which it stopped.
class CircuitWaves {
 public:
  using Outputs = std::vector<std::unique_ptr<CircuitOutput>>;

  /// `cycles` before and as many behind. What is passed by reference must outlive it.
  CircuitWaves(const Circuit& circuit, const CircuitPins& pins, const Outputs& outputs, std::uint64_t cycles);

  /// Each cycle, with the pins as they are before the edge at its end, if it has one there. `moved`: a token
  /// passed.
  void take(Cycles cycle, bool edge, bool moved);
  /// In this cycle, which has been taken. What happens later does not count.
  void happened(const std::string& what, Cycles cycle);
  bool complete() const { return !title_.empty() && left_ == 0; }

  /// Whether anything happened.
  bool any() const { return !title_.empty(); }
  /// With what the model has in place of the tokens on the outputs.
  PinWaves waves(const ClockDomain& clock) const;

 private:
  // What is kept of a cycle, but for the pins' bytes.
  struct Kept {
    Cycles cycle;
    bool edge_before;
    bool edge_after;
  };
  struct Token {
    std::uint64_t number;
    bool passed;
  };

  std::size_t slot(std::size_t age) const { return (taken_ - age) % kept_.size(); }
  bool outputs_changed() const;  ///< since the last cycle that was kept
  std::string pin_value(std::size_t slot, std::size_t pin) const;

  const Circuit& circuit_;
  const CircuitPins& pins_;
  const Outputs& outputs_;
  const std::uint64_t cycles_;
  std::vector<std::size_t> begins_;  // of each pin's bytes in those of a cycle, and the end
  std::vector<Kept> kept_;           // a ring
  std::vector<char> bytes_;          // of each of them
  std::vector<Token> tokens_;        // at each output, of each of them
  std::vector<std::uint64_t> written_;
  std::size_t taken_ = 0;
  bool edge_ = true;
  Cycles moved_{0};
  std::string title_;
  Cycles at_{0};
  std::uint64_t left_ = 0;  // cycles that are still wanted
};

}  // namespace parallax
