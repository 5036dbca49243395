// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <systemc>

#include "tlm/stage.hpp"
#include "tlm/stage_timing.hpp"

namespace parallax {

/// How a frame's bytes are cut, on the memory's side and on the stage's.
struct UnpackerConfig {
  std::uint64_t piece_bytes = 0;  ///< bytes that lie one after the other (DmaJob)
  Bytes burst{128};               ///< an input token; the last one of a piece may be shorter
  Bytes token{1};            ///< an output token; divides `burst`; the last one of a piece may be shorter
  std::size_t row = 0;       ///< values a row; 0 = whatever is sent
  std::uint64_t pieces = 1;  ///< of a frame
};

/// Bursts in, tokens out, one a cycle. The burst being cut lies in a register: its slot in the FIFO is free
/// as soon as its first token is out. Combinational. T is a byte type; the values are passed on as they are.
template <class T>
class Unpacker final : public Stage {
 public:
  StreamIn<std::uint8_t> in_bursts{"in_bursts"};
  StreamOut<T> out_tokens{"out_tokens"};

  Unpacker(const sc_core::sc_module_name& name, const UnpackerConfig& config, const ClockDomain& clock,
           Dataflow& dataflow)
      : Stage(name, clock, dataflow, 0) {
    static_assert(sizeof(T) == 1, "values are bytes");
    const std::uint64_t burst = config.burst.size();
    const std::uint64_t token = config.token.size();
    const auto cut = [token](std::uint64_t bytes) {
      const std::uint64_t tokens = (bytes + token - 1) / token;
      return std::vector<Phase>{fires().reads(0b1).writes(0b1), fires(tokens - 1).writes(0b1)};
    };
    Schedule schedule;
    for (std::uint64_t piece = 0; piece < config.pieces; ++piece) {
      schedule.repeat(config.piece_bytes / burst, cut(burst));
      if (config.piece_bytes % burst != 0) schedule.repeat(1, cut(config.piece_bytes % burst));
    }
    set_schedule(schedule);
    in_bursts.on_row(config.row, [this](const std::uint8_t* row, std::size_t size) {
      out_tokens.send_row(reinterpret_cast<const T*>(row), size);
    });
  }
};

}  // namespace parallax
