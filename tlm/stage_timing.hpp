// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace parallax {

/// How long a hardware stage takes, in cycles of the clock domain that it runs in.
struct StageTiming {
  std::uint32_t interval = 1;        ///< initiation interval: cycles between two tokens, at least 1
  std::uint32_t latency = 1;         ///< pipeline depth: cycles from a token's last input to its output
  std::uint32_t row_overhead = 0;    ///< cycles lost between two rows
  std::uint32_t frame_overhead = 0;  ///< cycles lost between two frames
};

}  // namespace parallax
