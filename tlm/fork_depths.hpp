// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tlm/fifo_kind.hpp"

namespace parallax {

/// A graph of stages and the streams between them, as far as it decides how deep a FIFO has to be where paths
/// fork and meet again. Streams lead downstream: the graph has no circle.
///
/// Stages pass elements (pixels, say) on, in order. An element is one token of a stream, or a group of them.
struct ForkGraph {
  /// A stage, by what it holds back.
  struct Node {
    std::uint64_t look_ahead = 0;  ///< elements that it has read beyond the one that it writes
    std::uint64_t latency = 0;     ///< cycles from reading to writing
    std::uint64_t group = 0;       ///< tokens of an element, if it reads or writes groups; else 0
  };
  /// A stream.
  struct Edge {
    std::size_t from = 0;  ///< the node that writes it
    std::size_t to = 0;    ///< the node that reads it, after `from`
    FifoOffsets offsets{1, 1};
    bool groups = false;  ///< an element is a group of tokens, as many as both nodes say
    bool late = false;    ///< read with the element that is written: its reader does not look ahead on it
  };
  std::vector<Node> nodes;  ///< upstream to downstream
  std::vector<Edge> edges;
};

/// For each edge the tokens that its FIFO must hold so that it does not hold up another path between a fork
/// and the stage where both meet again; 0: any depth will do.
///
/// Of two paths from a fork to a join that share no stage in between, the one that looks ahead less (if they
/// are alike, the one through fewer stages) must be able to hold, in its last stream, what the other one
/// holds beyond it:
/// - the difference of their look-ahead, which a path holds whatever happens;
/// - the other one's latencies and ways through FIFOs, at a token a cycle. Nothing is taken off for those of
///   the path itself, since it holds less when tokens come more slowly;
/// - a group, if stages on the other path work on groups. Stages in a row have the same one under way; of
///   groups that the fork itself writes, the token at hand belongs to the first;
/// - what comes while a slot is on its way back to the fork: through this FIFO, or, where the other path
///   looks ahead and that is more, through the other's FIFOs, less those of the path itself, so that both
///   hold about as much when the join is held up.
///
/// A stage that a fork feeds directly while another path leads to it lets the fork run ahead of it by all
/// that the direct stream holds. Where paths meet again behind it, this counts in place of the way to it.
std::vector<std::uint64_t> fork_depths(const ForkGraph& graph);

}  // namespace parallax
