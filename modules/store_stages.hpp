// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <systemc>
#include <vector>

#include "tlm/stage.hpp"

namespace parallax {

/// How records, one a token of pixels, lie in a store in external memory: a row's one after the other, each
/// row padded to whole bursts.
struct StoreLayout {
  struct Pass {
    std::uint64_t rows = 0;
    std::uint64_t record_bytes = 0;  ///< of a token
  };
  std::uint64_t width = 0;   ///< tokens of a row
  std::vector<Pass> passes;  ///< of one frame, one after the other
  Bytes word{8};             ///< width of the engine's stream side
  Bytes burst{128};          ///< whole words

  std::uint64_t row_bursts(const Pass& pass) const {
    const std::uint64_t bytes = burst.count();
    return (width * pass.record_bytes + bytes - 1) / bytes;
  }
  std::uint64_t row_bytes(const Pass& pass) const { return row_bursts(pass) * burst.count(); }
};

/// Records in, bursts out: a word a cycle, and no more than a record a cycle. A burst goes out with its last
/// word. Combinational; the burst lies in a register. Values come in by rows; the padding is zeros.
class StorePackStage final : public Stage {
 public:
  StreamIn<std::uint8_t> in_records{"in_records"};
  StreamOut<std::uint8_t> out_bursts{"out_bursts"};

  StorePackStage(const sc_core::sc_module_name& name, const StoreLayout& layout, const ClockDomain& clock,
                 Dataflow& dataflow);
};

/// Bursts in, records out, likewise: a burst is read with its first word. `backwards`: rows come from their
/// end, the padding first. Values come in by bursts and go out by rows, in the order in which they were
/// packed.
class StoreUnpackStage final : public Stage {
 public:
  StreamIn<std::uint8_t> in_bursts{"in_bursts"};
  StreamOut<std::uint8_t> out_records{"out_records"};

  StoreUnpackStage(const sc_core::sc_module_name& name, const StoreLayout& layout, bool backwards,
                   const ClockDomain& clock, Dataflow& dataflow);
};

}  // namespace parallax
