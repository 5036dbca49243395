// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/config/dma_config.hpp"
#include "tlm/dma.hpp"

namespace parallax {

/// Engine parameters of a configured port.
inline DmaEngineConfig engine_config(const DmaPortConfig& port) {
  return {Bytes(port.burst_bytes), port.outstanding, port.fifo_bytes / port.burst_bytes};
}

}  // namespace parallax
