// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <systemc>

#include "modules/pixel_format.hpp"
#include "tlm/stage.hpp"

namespace parallax {

struct PixelUnpackConfig {
  PixelFormat format = PixelFormat::kMono8;
  std::uint64_t piece_bytes = 0;  ///< bytes that lie one after the other (DmaJob); whole pixels
  std::uint64_t pieces = 1;       ///< of a frame
  Bytes burst{128};               ///< an input token; the last one of a piece may be shorter
  std::size_t width = 0;          ///< px of a row
  std::uint64_t pixels = 1;       ///< of an output token; divides `width`
};

/// Bursts of an image in, grey pixels out, one a cycle (pixel_format.hpp; paper, section Architecture: pixels
/// arrive in several formats). A burst is read when a pixel ends in it that did not end in the one before;
/// one in which no pixel ends takes a cycle of its own. Combinational; the burst lies in a register.
class PixelUnpackStage final : public Stage {
 public:
  StreamIn<std::uint8_t> in_bursts{"in_bursts"};
  StreamOut<Gray> out_tokens{"out_tokens"};

  PixelUnpackStage(const sc_core::sc_module_name& name, const PixelUnpackConfig& config,
                   const ClockDomain& clock, Dataflow& dataflow);
};

}  // namespace parallax
