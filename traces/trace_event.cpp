// SPDX-License-Identifier: Apache-2.0
#include "traces/trace_event.hpp"

#include <array>

namespace parallax {

const char* name_of(FrameStep step) {
  static constexpr std::array<const char*, kFrameSteps> kNames{
      "exposed",         "first_byte",     "startable",         "in_memory", "core_started",
      "first_disparity", "last_disparity", "results_in_memory", "at_host"};
  return kNames.at(index_of(step));
}

}  // namespace parallax
