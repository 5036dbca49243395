// SPDX-License-Identifier: Apache-2.0
#include "platform/config/machine_config.hpp"

#include <utility>

#include "platform/config/schema.hpp"
#include "platform/config/stage_schema.hpp"

namespace parallax {

void MachineConfig::validate() const {
  image.validate();
  camera.validate();
  memory.validate();
  dma.validate();
  link.validate();
  streams.validate();
  tiles.validate();
  rectification.validate();
  census.validate();
  matching.validate();
  matching.validate_tokens(timing.pixels_per_token);
  matching.validate_census(census.enabled);
  subpixel.validate();
  uniqueness.validate();
  consistency.validate();
  texture.validate();
  for (const auto& filter : filters.all()) filter->validate(*this);
}

void MachineConfig::add(std::unique_ptr<DisparityFilter> filter) {
  streams.add(filter->stream());
  filters.add(std::move(filter));
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
  for (const auto& filter : config.filters.all()) filter->describe_function(schema, config);
  describe(schema, config.timing);
  for (const auto& filter : config.filters.all()) {
    describe_timing(schema, filter->name(), "pixels", LooksAhead::kYes, filter->timing(config));
  }
  describe(schema, config.energy);
}

}  // namespace parallax
