// SPDX-License-Identifier: Apache-2.0
#include "tlm/pin_config.hpp"

#include <fmt/format.h>

#include "tlm/error.hpp"
#include "tlm/stalls.hpp"

namespace parallax {

void PinConfig::validate(const std::string& where) const {
  const auto fail = [&where](const std::string& what) {
    throw UserError(fmt::format("{}: {}", where, what));
  };
  if (interval < 1) fail("an interval of 0 cycles; it is at least 1");
  if (burst < 1) fail("a burst of 0 tokens; it has at least 1");
  if (stall > Stalls::kMost)
    fail(fmt::format("stalls in {} of 1000 cycles are outside 0 to {}", stall, Stalls::kMost));
  if (frame_tokens == 0 && (flush > 0 || skip > 0))
    fail("flush and skip are of a frame, and frame_tokens is 0");
  if (row_tokens > 0 && frame_tokens % row_tokens != 0) {
    fail(fmt::format("a frame of {} tokens is no whole number of rows of {}", frame_tokens, row_tokens));
  }
}

void require_burst_fits(const std::string& where, std::uint64_t burst, const StreamBase& stream) {
  if (burst <= stream.depth()) return;
  throw UserError(fmt::format("{}: bursts of {} tokens do not fit into stream '{}' of depth {}", where, burst,
                              stream.name(), stream.depth()));
}

void require_clock(const std::string& where, const ClockDomain& of_stream, const ClockDomain& of_pins) {
  if (of_stream.frequency() == of_pins.frequency()) return;
  throw UserError(fmt::format("{}: its stream has the clock '{}' of {} Hz there, its pins '{}' of {} Hz",
                              where, of_stream.name(), of_stream.frequency().count(), of_pins.name(),
                              of_pins.frequency().count()));
}

}  // namespace parallax
