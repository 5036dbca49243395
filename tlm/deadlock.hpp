// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tlm/dataflow.hpp"
#include "tlm/stream_base.hpp"

namespace parallax {

/// The waits among `all` that close a circle, in order; empty when none do.
std::vector<Wait> closed_circle(const std::vector<Wait>& all);

/// The same for numbered nodes: indices of arcs (who waits, for whom) that close a circle.
std::vector<std::size_t> closed_circle(const std::vector<std::pair<std::size_t, std::size_t>>& arcs);

/// What frees a graph that deadlocks.
struct Remedy {
  struct Depth {
    const StreamBase* stream;
    std::uint32_t tokens;  ///< more than the stream has now
  };
  /// One stream where a single one is enough. Else a set of which no depth can be less while the others are
  /// as they are; another set may cost less. Empty: see `obstacle`.
  std::vector<Depth> depths;
  /// Why no depth is known to help; empty when `depths` is not, and when the graph does not deadlock.
  std::string obstacle;
};

/// The smallest depths with which every stage of the graph can complete `frames` frames; after elaboration.
///
/// Each depth is exact: with one token less the graph gets stuck. Where raising a single stream frees it, the
/// stream chosen is the one whose raise adds the fewest bits, and among equal ones the fewest tokens.
/// Whatever lies in kernel time is taken to bring and take every token that the stages ask for; where it lies
/// within a circle of streams, so that this says nothing, it is the obstacle.
Remedy smallest_remedy(const Dataflow& dataflow, std::uint64_t frames);

}  // namespace parallax
