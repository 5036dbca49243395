// SPDX-License-Identifier: Apache-2.0
#include "platform/config/machine_config.hpp"

#include "platform/config/schema.hpp"
#include "platform/config/stage_schema.hpp"

namespace parallax {

void MachineConfig::validate() const {
  image.validate();
  camera.validate();
  memory.validate();
  dma.validate();
  link.validate();
  tiles.validate();
  rectification.validate();
  census.validate();
  matching.validate();
  subpixel.validate();
  uniqueness.validate();
  consistency.validate();
  texture.validate();
  speckle.validate();
  gap_interpolation.validate();
  noise_reduction.validate();
}

void describe(Schema& schema, MachineConfig& config) {
  describe(schema, config.clocks);
  describe(schema, config.image);
  describe(schema, config.camera);
  describe(schema, config.memory);
  describe(schema, config.memory_map);
  describe(schema, config.dma);
  describe(schema, config.link);
  describe(schema, config.software);
  describe(schema, config.streams);
  describe(schema, config.tiles);

  describe(schema, config.rectification);
  describe(schema, config.census);
  describe(schema, config.matching);
  describe(schema, config.subpixel);
  describe(schema, config.uniqueness);
  describe(schema, config.consistency);
  describe(schema, config.texture);
  describe(schema, config.speckle);
  describe(schema, config.gap_interpolation);
  describe(schema, config.noise_reduction);
  describe(schema, config.timing);
  describe(schema, config.energy);
}

}  // namespace parallax
