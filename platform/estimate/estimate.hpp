// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "platform/config/machine_config.hpp"
#include "platform/estimate/device_file.hpp"
#include "platform/estimate/fifo_circuit.hpp"
#include "platform/estimate/resources.hpp"

namespace parallax {

/// A part of the machine, and what it takes.
struct PartEstimate {
  enum class Kind {
    kStage,   ///< a stage without its memories
    kBuffer,  ///< a memory of a stage: lines of an image, path costs
    kFifo,    ///< a stream between stages
    kEngine,  ///< a DMA engine
  } kind;
  std::string name;   ///< as in reports: a stage, a stream, a memory's port; of a buffer, what it holds
  std::string owner;  ///< of a buffer: its stage; else empty
  std::string shape;  ///< of a FIFO: "16 x 352 bit, registered"; else empty
  FifoCircuit fifo;   ///< of a FIFO
  Resources resources;
  bool calibrated = false;  ///< whether its circuit was held against what a synthesiser makes of it
};

struct ResourceEstimate {
  std::vector<PartEstimate> parts;  ///< upstream to downstream, of each kind
  Resources total;
};

/// The size of the image that the machine is built for, px; 0: the largest that it is configured for: lines
/// of tiles.limit columns, image.max_height rows.
struct EstimateSize {
  int width = 0;
  int height = 0;
};

/// What the machine's circuits take in the device's family: stages, their memories, FIFOs and DMA engines.
/// The memory controller, cameras, link, and software are none of them. Plain arithmetic: no simulation, some
/// thousand machines a second. Throws UserError where the size does not fit into the machine's tiles.
ResourceEstimate estimate(const MachineConfig& config, const DeviceFile& device,
                          const EstimateSize& size = {});

}  // namespace parallax
