// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "traces/trace_event.hpp"

namespace parallax {

/// One end of a window: a frame, a row of a frame, or a date.
struct TraceBound {
  std::int64_t frame = 0;  ///< from 0, unless `time`
  std::optional<std::int32_t> row;
  std::optional<Picoseconds> time;
};

/// "8" (a frame, counted from 1), "8:120" (a row of it, counted from 0), "12.5ms" (ps, ns, us, ms, s).
/// `option` is named in the UserError when the text is none of these.
TraceBound read_trace_bound(const std::string& option, const std::string& text);

/// The part of a run that is traced. Frames and rows are each part's own: a stage is traced while it works on
/// them.
struct TraceWindow {
  std::optional<TraceBound> from;  ///< inclusive
  std::optional<TraceBound> to;    ///< frames and rows inclusive, dates exclusive

  /// Throws UserError when an end is outside a run of so many frames and rows, or after the other.
  void check(std::int64_t frames, std::int32_t rows) const;
  /// Whether something that happens to `position` from `begin` to `end` is in it.
  bool contains(const TracePosition& position, Picoseconds begin, Picoseconds end) const;
  bool bounded() const { return from || to; }
};

}  // namespace parallax
