// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace parallax {

class Schema;

/// Clock domains, in Hz. Exact integers, so that conversions between domains never drift.
struct ClockConfig {
  std::int64_t core_hz = 188'000'000;    ///< the pipeline; 1 Hz to 10 GHz; F
  std::int64_t memory_hz = 533'333'333;  ///< the memory's bus; 1 Hz to 10 GHz; I
  std::int64_t camera_hz = 80'000'000;   ///< pixel clock of a sensor; 1 Hz to 10 GHz; own choice
  std::int64_t link_hz = 125'000'000;    ///< the Ethernet interface; 1 Hz to 10 GHz; S
};

void describe(Schema& schema, ClockConfig& config);

}  // namespace parallax
