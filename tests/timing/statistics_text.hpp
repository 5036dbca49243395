// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <string>

#include "tlm/stage.hpp"

namespace parallax::test {

/// All that a stream and a stage say of a run, as text to compare.
inline std::string statistics_text(const StreamBase& stream) {
  const StreamStatistics& s = stream.statistics();
  const Occupancy& o = stream.occupancy();
  std::string text =
      fmt::format("{}: written {} read {} high water {} blocked {} starved {}; empty {} full {}, mean {};",
                  stream.name(), s.written, s.read, s.high_water, s.blocked_on_full.count(),
                  s.starved_on_empty.count(), o.empty(), o.full(), o.mean());
  for (std::size_t bin = 0; bin < o.bins(); ++bin) text += fmt::format(" {}", o.cycles(bin));
  return text + "\n";
}

inline std::string text_of(const StageStatistics& s) {
  return fmt::format("firings {} busy {} blanking {} starved {} blocked {} memory {} synchroniser {}",
                     s.firings, s.busy.count(), s.blanking.count(), s.starved.count(), s.blocked.count(),
                     s.memory.count(), s.synchroniser.count());
}

inline std::string statistics_text(const Stage& stage) {
  std::string text = fmt::format("{}: {}\n", stage.name(), text_of(stage.statistics()));
  for (std::size_t i = 0; i < stage.frames().size(); ++i) {
    const FrameDates& frame = stage.frames()[i];
    text += fmt::format("  fired {} to {}, wrote {} to {}, before {}\n", frame.first_firing.count(),
                        frame.last_firing.count(), frame.first_write.count(), frame.last_write.count(),
                        text_of(frame.before));
    if (frame.before.total() != frame.first_firing) text += "  shares do not sum to the date\n";
  }
  return text;
}

}  // namespace parallax::test
