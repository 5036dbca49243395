// SPDX-License-Identifier: Apache-2.0
#include "platform/machine_config.hpp"

#include "platform/schema.hpp"

namespace parallax {

void MachineConfig::validate() const {
  image.validate();
  dma.validate();
  link.validate();
}

void describe(Schema& schema, MachineConfig& config) {
  describe(schema, config.clocks);
  describe(schema, config.image);
  describe(schema, config.camera);
  describe(schema, config.memory);
  describe(schema, config.dma);
  describe(schema, config.link);
  describe(schema, config.streams);
  describe(schema, config.timing);
}

}  // namespace parallax
