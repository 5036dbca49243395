// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "modules/token_format.hpp"
#include "platform/cosim/pin_bits.hpp"
#include "platform/cosim/pin_list.hpp"
#include "platform/cosim/vector_manifest.hpp"
#include "platform/input/circuit_options.hpp"

namespace parallax {

/// The pins of a circuit at one port of its stage. Ports may share a handshake: tokens pass at all of them in
/// the same cycle, or at none.
struct PortPins {
  std::string port;
  bool is_input = false;
  struct Data {
    TokenField field;  ///< the bits of the token that the pin carries
    PinBits pin;
  };
  std::vector<Data> data;  ///< one for the whole token, or one for each field
  PinBits valid;
  PinBits ready;
  // Beside the data.
  PinBits first;  ///< 1 with the first token of a frame
  PinBits last;   ///< 1 with the last token of a row
  // Beside an input's data.
  PinBits keep;         ///< all ones: every byte counts
  PinBits row;          ///< of the token's first pixel in the image, or the tile
  PinBits column;       ///< likewise; of tokens that know no rows their number in the frame
  PinBits line_valid;   ///< 1 from a row's first token on until its last one is taken
  PinBits frame_valid;  ///< likewise of a frame, or tile, and the zeros behind it
  PinBits group;        ///< of a pixel that has several tokens, which one

  /// Whether tokens pass at both together.
  bool joined_with(const PortPins& other) const {
    const auto share = [&](PinBits PortPins::*pin) { return this->*pin && this->*pin == other.*pin; };
    return is_input == other.is_input && (share(&PortPins::valid) || share(&PortPins::ready) ||
                                          share(&PortPins::line_valid) || share(&PortPins::frame_valid));
  }
};

/// Which pin of a circuit is what: by the names that such circuits usually have, or as the user says.
struct CircuitPins {
  const parallax_pin* clock = nullptr;  ///< none: combinational
  PinBits reset;
  bool reset_is_low = false;    ///< active-low
  PinBits enable;               ///< of the clock
  std::vector<PortPins> ports;  ///< as the manifest's streams
};

/// Finds them for the ports of a stage, and sets the constants; the list must outlive what is found. Throws
/// UserError when a pin has another width than the tokens, does not hold what is counted on it or runs the
/// other way; with all of them, when ports have no pin and inputs are driven by nobody. `stage` may be what
/// is known before a token has passed.
CircuitPins find_pins(const PinList& circuit, const VectorManifest& stage, const CircuitOptions& options);

}  // namespace parallax
