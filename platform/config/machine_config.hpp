// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "modules/census.hpp"
#include "modules/consistency.hpp"
#include "modules/gap_interpolation.hpp"
#include "modules/matching.hpp"
#include "modules/noise_reduction.hpp"
#include "modules/rectification.hpp"
#include "modules/speckle.hpp"
#include "modules/subpixel.hpp"
#include "modules/texture.hpp"
#include "modules/uniqueness.hpp"
#include "platform/config/camera_config.hpp"
#include "platform/config/clock_config.hpp"
#include "platform/config/disparity_filters.hpp"
#include "platform/config/dma_config.hpp"
#include "platform/config/energy_config.hpp"
#include "platform/config/image_config.hpp"
#include "platform/config/link_config.hpp"
#include "platform/config/memory_config.hpp"
#include "platform/config/memory_map_config.hpp"
#include "platform/config/pipeline_timing.hpp"
#include "platform/config/software_config.hpp"
#include "platform/config/stream_config.hpp"
#include "platform/config/tile_config.hpp"

namespace parallax {

/// Everything that a run of the machine depends on, apart from its input.
struct MachineConfig {
  ClockConfig clocks;
  ImageConfig image;
  CameraConfig camera;
  MemoryConfig memory;
  MemoryMapConfig memory_map;
  DmaConfig dma;
  LinkConfig link;
  SoftwareConfig software;
  StreamConfig streams;
  TileConfig tiles;
  EnergyConfig energy;

  RectificationConfig rectification;
  CensusConfig census;
  MatchingConfig matching;
  SubpixelConfig subpixel;
  UniquenessConfig uniqueness;
  ConsistencyConfig consistency;
  TextureConfig texture;
  SpeckleConfig speckle;
  GapInterpolationConfig gap_interpolation;
  NoiseReductionConfig noise_reduction;
  PipelineTiming timing;
  DisparityFilters filters = disparity_filters();  ///< behind the texture filter

  /// Puts a filter behind the others.
  void add(std::unique_ptr<DisparityFilter> filter);
  /// Throws UserError, one line that names the keys, when values are fine alone but not together.
  void validate() const;
};

/// Declares all keys.
void describe(Schema& schema, MachineConfig& config);

}  // namespace parallax
