// SPDX-License-Identifier: Apache-2.0
#include "platform/config/dma_config.hpp"

#include <fmt/format.h>

#include "platform/config/schema.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

void validate_port(const std::string& name, const DmaPortConfig& port) {
  if (port.data_bits % 8 != 0) {
    throw UserError(fmt::format("dma.{}.data_bits = {}: must be a multiple of 8", name, port.data_bits));
  }
  if (port.burst_bytes % (port.data_bits / 8) != 0) {
    throw UserError(
        fmt::format("dma.{0}.burst_bytes = {1}: must be a multiple of the {2} bytes of dma.{0}.data_bits",
                    name, port.burst_bytes, port.data_bits / 8));
  }
  if (port.fifo_bytes < port.burst_bytes) {
    throw UserError(
        fmt::format("dma.{0}.fifo_bytes = {1}: must hold a burst: at least dma.{0}.burst_bytes = {2}", name,
                    port.fifo_bytes, port.burst_bytes));
  }
}

void describe_port(Schema& schema, const std::string& name, const std::string& what, DmaPortConfig& port) {
  const std::string prefix = "dma." + name + ".";
  const Provenance origin = chosen("not published; usual for an AXI bus of 64 bit");
  schema.integer(prefix + "burst_bytes", port.burst_bytes, {1, 4096}, "B",
                 "Burst length of the engine that " + what + "; a multiple of its data width.", origin);
  schema.integer(prefix + "outstanding", port.outstanding, {1, 256}, "bursts",
                 "Bursts that the engine that " + what + " has under way at most.", origin);
  schema.integer(prefix + "data_bits", port.data_bits, {8, 8192}, "bit",
                 "Width of the engine that " + what + "; a multiple of 8.", origin);
  schema.integer(prefix + "fifo_bytes", port.fifo_bytes, {1, 1 << 20}, "B",
                 "Buffer of the engine that " + what + "; at least one burst.", origin);
}

}  // namespace

void DmaConfig::validate() const {
  validate_port("camera", camera);
  validate_port("left", left);
  validate_port("right", right);
  validate_port("map", map);
  validate_port("output", output);
  validate_port("link", link);
  validate_port("buffer", buffer);
}

void describe(Schema& schema, DmaConfig& config) {
  describe_port(schema, "camera", "writes the camera's frames", config.camera);
  describe_port(schema, "left", "reads the left image", config.left);
  describe_port(schema, "right", "reads the right image", config.right);
  describe_port(schema, "map", "reads the rectification map", config.map);
  describe_port(schema, "output", "writes the results", config.output);
  describe_port(schema, "link", "reads the results to send them", config.link);
  describe_port(schema, "buffer", "writes, or reads back, what the matcher keeps in memory", config.buffer);
}

}  // namespace parallax
