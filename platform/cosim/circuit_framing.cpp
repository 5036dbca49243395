// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/circuit_framing.hpp"

#include <fmt/format.h>

namespace parallax {

void CircuitFraming::look(std::uint64_t token, Cycles cycle) {
  if ((!pins_.first && !pins_.last) || !breach_.empty()) return;
  const std::uint64_t of_pass = stage_.pass_tokens(stream_);
  const char* const pass = of_pass < stream_.frame_tokens ? "tile" : "frame";
  const std::uint64_t at = token % of_pass;
  if (pins_.first && pins_.first.any() != (at == 0))
    return tell(pins_.first, fmt::format("the first token of each {}", pass), token, cycle);
  const std::uint64_t of_row = stream_.shape.row_tokens;
  if (!pins_.last || of_row == 0) return;
  const bool ends_pass = at + 1 == of_pass;
  const bool ends_row = (at + 1) % of_row == 0;
  if (ends_row && !ends_pass && !row_has_ended_) {
    row_has_ended_ = true;
    each_row_ = pins_.last.any();
  }
  if (pins_.last.any() == (ends_pass || (ends_row && each_row_))) return;
  const std::string each = !row_has_ended_ ? fmt::format("row, or {}", pass) : each_row_ ? "row" : pass;
  tell(pins_.last, fmt::format("the last token of each {}", each), token, cycle);
}

void CircuitFraming::tell(const PinBits& pin, const std::string& where, std::uint64_t token, Cycles cycle) {
  const ValuePlace place = stage_.place(stream_, token, 0);
  const std::string in_image =
      place.row < 0 ? "" : fmt::format(" (row {}, column {})", place.row, place.column);
  breach_ = fmt::format("{}: {} is {} with token {} of frame {}{}, in cycle {}; it is to be 1 with {} alone",
                        stream_.name, pin.name(), pin.any() ? 1 : 0, token % stream_.frame_tokens,
                        place.frame, in_image, cycle.count(), where);
}

}  // namespace parallax
