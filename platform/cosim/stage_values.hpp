// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

#include "modules/map_codec.hpp"
#include "platform/config/machine_config.hpp"
#include "platform/machine/circuit_end.hpp"
#include "platform/machine/pipeline.hpp"
#include "platform/machine/tile_plan.hpp"
#include "platform/machine/token_shape.hpp"

namespace parallax {

/// A stage of the machine without the machine and without time: tokens in, and the tokens out that its kernel
/// makes of them, as they lie on the wires of a circuit. Kernels work on rows: what a row makes is there when
/// the row is complete.
class StageValues {
 public:
  struct Port {
    std::string name;    ///< "in_left"
    std::string stream;  ///< as in streams.NAME.depth; of a fork the first one
    bool is_input = false;
    TokenShape shape;
    std::uint64_t pass_tokens = 0;  ///< of an image, or a tile of it; 0: of no fixed number
  };

  /// For images of that size, as they are processed, with `map`, which must outlive the object; `config` too.
  /// A process can have one. Throws UserError when the machine has no such stage, or when its tokens are not
  /// known as they lie on wires; `option` names it.
  StageValues(const MachineConfig& config, int width, int height, const EncodedMap& map,
              const std::string& stage, const char* option);
  ~StageValues();

  /// Inputs first.
  const std::vector<Port>& ports() const { return ports_; }
  /// The next token of an input: as many bits as its format has, bit 0 lowest in the first word.
  void push(std::size_t port, const std::vector<std::uint64_t>& bits);
  /// The next token of an output, if it is there already.
  bool pop(std::size_t port, std::vector<std::uint64_t>& bits);

 private:
  const TilePlan tiles_;
  const EncodedMap tiled_map_;
  ClockDomain clock_;
  Dataflow dataflow_;
  std::unique_ptr<Pipeline> pipeline_;
  std::vector<Port> ports_;
  std::vector<std::unique_ptr<CircuitEnd>> ends_;  // by port
};

}  // namespace parallax
