// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "modules/store_stages.hpp"
#include "platform/config/machine_config.hpp"

namespace parallax {

/// What the matcher keeps in external memory (MatchingStore), as it lies there: one row of path costs, each
/// overwritten by the next, and after it a frame of the first pass. All tiles of an image use the same. Keys,
/// registers and memory ports call it by the device's name for its port, "buffer".
struct MatcherStore {
  StoreLayout rows;   ///< a pass: its rows that are written and read back
  StoreLayout frame;  ///< one pass

  bool keeps_rows() const;
  bool keeps_frame() const;
  /// Bytes in memory, and from their begin to that of the frame.
  std::uint64_t bytes() const { return frame_offset() + frame_bytes(); }
  std::uint64_t frame_offset() const;
  std::uint64_t frame_bytes() const;
};

/// For images, or tiles of them, of this size.
MatcherStore matcher_store(const MachineConfig& config, int width, int height);

}  // namespace parallax
