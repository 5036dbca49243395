// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "modules/token_format.hpp"
#include "platform/cosim/circuit_library.hpp"
#include "platform/cosim/vector_manifest.hpp"
#include "platform/input/circuit_options.hpp"

namespace parallax {

/// The pins of a circuit at one port of its stage; nullptr: it has none of that kind.
struct PortPins {
  std::string port;
  bool is_input = false;
  struct Data {
    TokenField field;  ///< the bits of the token that the pin carries
    const parallax_pin* pin;
  };
  std::vector<Data> data;  ///< one for the whole token, or one for each field
  const parallax_pin* valid = nullptr;
  const parallax_pin* ready = nullptr;
  // Beside an input's data.
  const parallax_pin* first = nullptr;   ///< 1 with the first token of a frame
  const parallax_pin* last = nullptr;    ///< 1 with the last token of a row
  const parallax_pin* keep = nullptr;    ///< all ones: every byte counts
  const parallax_pin* row = nullptr;     ///< of the token's first pixel in the image, or the tile
  const parallax_pin* column = nullptr;  ///< likewise; of tokens that know no rows their number in the frame
  const parallax_pin* group = nullptr;   ///< of a pixel that has several tokens, which one
};

/// Which pin of a circuit is what: by the names that such circuits usually have, or as the user says.
struct CircuitPins {
  const parallax_pin* clock = nullptr;  ///< none: combinational
  const parallax_pin* reset = nullptr;
  bool reset_is_low = false;             ///< active-low
  const parallax_pin* enable = nullptr;  ///< of the clock
  std::vector<PortPins> ports;           ///< as the manifest's streams
};

/// Finds them for the ports of a stage, and sets the constants. Throws UserError when a port has no pin, when
/// a pin has another width than the tokens, does not hold what is counted on it, runs the other way, or is an
/// input that nobody drives.
CircuitPins find_pins(const Circuit& circuit, const VectorManifest& stage, const CircuitOptions& options);

}  // namespace parallax
