// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "platform/cosim/pin_bits.hpp"
#include "platform/cosim/pin_list.hpp"

namespace parallax {

/// The pins of a circuit by their names, and which of their bits have a use.
class PinLookup {
 public:
  using Names = std::vector<std::string>;

  explicit PinLookup(const PinList& circuit) : circuit_(circuit) {}

  Names names() const;

  /// PIN, PIN[BIT] or PIN[HIGH:LOW], as the user says in `option`. Throws UserError, with the option, when
  /// there is no such pin, or it has no such bits.
  PinBits named(const std::string& word, const std::string& option) const;
  /// The first of these pins that there is and that has no use yet; with a direction, that runs this way.
  const parallax_pin* find(const Names& names, std::optional<bool> is_input = std::nullopt) const;

  /// These bits have this use. Bits of an input that nobody sets later are 0. Throws UserError when they have
  /// another: what ports share is their handshake and what stands beside the data ("in_left.valid" and
  /// "in_right.valid").
  void take(const PinBits& bits, const std::string& role);

  /// What has no use: of an input, bits that lie beside each other; outputs as a whole.
  std::vector<PinBits> unused(bool is_input) const;

 private:
  const parallax_pin* pin(const std::string& name) const;

  const PinList& circuit_;
  std::map<const parallax_pin*, std::vector<std::string>> roles_;  // of each bit; empty: none
};

}  // namespace parallax
