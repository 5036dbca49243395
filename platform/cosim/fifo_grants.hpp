// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "platform/cosim/fifo_capture.hpp"

namespace parallax {

/// When a FIFO in a simulation would have handed out each token, and taken each, whether anybody wanted or
/// not. Dates are cycles of the side.
struct FifoGrants {
  struct Grant {
    std::int64_t since = 0;  ///< the cycle after the token before it moved: from here on it is the next
    std::optional<std::int64_t> first;  ///< cycle in which it can move; none: never, up to the end
  };

  explicit FifoGrants(const FifoCapture& capture);

  std::string file;
  bool two_clocks = false;
  std::vector<Grant> slots;   ///< write side, one for each token and for the one that would come next
  std::vector<Grant> tokens;  ///< read side, likewise
  std::vector<std::int64_t> write_dates, read_dates;  ///< of each token that moved

  /// What no FIFO does; empty: nothing.
  std::string fault;
  std::size_t fault_token = 0;
  bool fault_of_reader = true;   ///< the side that it is about
  std::int64_t fault_cycle = 0;  ///< of that side

  /// Edges of the reader's clock from a write to a read: with two clocks, the first one strictly after is 1.
  std::int64_t to_reader(std::int64_t written, std::int64_t read) const;
  /// Edges of the writer's clock from a read to a write.
  std::int64_t to_writer(std::int64_t read, std::int64_t written) const;
  /// Whether a token was read at or, with two clocks, before the writer's edge of `cycle`.
  bool was_read_by(std::size_t token, std::int64_t cycle) const;
  std::int64_t last_read_cycle() const;
  std::int64_t last_write_cycle() const;
  /// Tokens held just before an edge of one side.
  std::size_t fill(bool of_reader, std::int64_t cycle) const;
  /// Largest number of tokens held.
  std::size_t most_held() const;

 private:
  std::vector<std::int64_t> write_edges_, read_edges_;  // their times
};

}  // namespace parallax
