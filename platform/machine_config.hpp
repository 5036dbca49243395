// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/camera_config.hpp"
#include "platform/clock_config.hpp"
#include "platform/dma_config.hpp"
#include "platform/image_config.hpp"
#include "platform/link_config.hpp"
#include "platform/memory_config.hpp"
#include "platform/pipeline_timing.hpp"
#include "platform/stream_config.hpp"

namespace parallax {

/// Everything that a run of the machine depends on, apart from its input.
struct MachineConfig {
  ClockConfig clocks;
  ImageConfig image;
  CameraConfig camera;
  MemoryConfig memory;
  DmaConfig dma;
  LinkConfig link;
  StreamConfig streams;
  PipelineTiming timing;

  /// Throws UserError, one line that names the keys, when values are fine alone but not together.
  void validate() const;
};

/// Declares all keys.
void describe(Schema& schema, MachineConfig& config);

}  // namespace parallax
