// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "tlm/stage.hpp"
#include "tlm/units.hpp"

namespace parallax {

/// A stage with what it declares, for reports.
struct StageInfo {
  const Stage* stage = nullptr;
  Bits storage{0};         ///< line buffers and the like, beside the FIFOs
  std::size_t passes = 1;  ///< times that the stage goes through its schedule for one frame
  bool enabled = true;     ///< false: a filter that is off, so that tokens pass it as they are

  std::uint64_t cycles_per_frame() const { return stage->schedule().cycles() * passes; }
  /// Dates of the first or the last pass over frame `frame`.
  const FrameDates& first_pass(std::size_t frame) const { return stage->frames()[frame * passes]; }
  const FrameDates& last_pass(std::size_t frame) const { return stage->frames()[(frame + 1) * passes - 1]; }
};

}  // namespace parallax
