// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace parallax {

class Schema;

/// One DMA engine between the memory and a stream.
struct DmaPortConfig {
  std::uint32_t burst_bytes = 128;  ///< bytes per burst, a multiple of the data width, 1 to 4096; own choice
  std::uint32_t outstanding = 4;    ///< bursts requested and not yet answered, 1 to 256; own choice
  std::uint32_t data_bits = 64;     ///< width of the engine's stream side, 8 to 8192, whole bytes; own choice
  std::uint32_t fifo_bytes = 1024;  ///< buffer of the engine, at least one burst, up to 1 MiB; own choice
};

/// The ports of the machine's memory.
struct DmaConfig {
  DmaPortConfig camera;                     ///< both sensors, writes frames
  DmaPortConfig left;                       ///< reads the left image
  DmaPortConfig right;                      ///< reads the right image
  DmaPortConfig map;                        ///< reads the rectification map
  DmaPortConfig output;                     ///< writes results
  DmaPortConfig link;                       ///< reads results to send them
  DmaPortConfig buffer{128, 8, 256, 2048};  ///< write and read back what the matcher keeps in memory

  /// Throws UserError when a burst is no multiple of its port's width or does not fit into the port's buffer.
  void validate() const;
};

void describe(Schema& schema, DmaConfig& config);

}  // namespace parallax
