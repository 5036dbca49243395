// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "platform/cosim/fifo_capture.hpp"
#include "tlm/fifo_kind.hpp"

namespace parallax {

/// A FIFO as a stream of the configuration has it (FifoConfig).
struct FifoDescription {
  bool two_clocks = false;
  std::int64_t write_to_read = 1;  ///< edges
  std::int64_t read_to_write = 1;
  std::int64_t depth = 1;  ///< tokens
  /// Of the writer's clock; with two clocks the most of all captures, as it depends on how they stand to each
  /// other.
  std::int64_t not_ready_cycles = 0;

  /// The kind that has these offsets, kFree when none has.
  FifoKind kind() const;
  /// Keys and values of a preset for the stream `name`, those alone that differ from the kind's own:
  /// `streams.NAME.kind`, ...
  std::vector<std::pair<std::string, std::string>> keys(const std::string& name) const;
};

/// What was found of a FIFO.
struct FifoFinding {
  std::optional<FifoDescription> description;  ///< none: `reason` says why
  std::string reason;                          ///< one sentence
  bool needs_stalls = false;                   ///< other stalls than those in the captures could tell
  std::size_t tokens = 0;                      ///< written in all captures
  std::size_t awaited = 0;                     ///< of these, tokens that were seen to become readable
  std::size_t refused = 0;                     ///< slots that were seen to become writable

  /// Where the last capture leaves every description.
  struct Place {
    std::string file;
    std::size_t token = 0;   ///< from 0 on
    std::int64_t cycle = 0;  ///< of the reader's clock where it is about reading, else of the writer's
    std::size_t fill = 0;    ///< tokens held then
  };
  std::optional<Place> place;
};

/// The one description that every date in all captures follows, with zero tolerance: in each cycle the FIFO
/// says that it has a token, or takes one, exactly when the description does. Offsets up to `kMostEdges` are
/// tried.
FifoFinding describe_fifo(const std::vector<FifoCapture>& captures);

}  // namespace parallax
