// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace parallax {

/// Depths of the FIFOs of a machine, in their order, in tokens.
using Depths = std::vector<std::int64_t>;

/// A FIFO whose smallest depth is wanted.
struct FifoRange {
  std::int64_t width = 1;  ///< bits of a token: what a step costs
  std::int64_t least = 1;  ///< tokens, 1 and more: fewer are left to the proof
  std::int64_t first = 1;  ///< tokens, no fewer than `least`: a guess, tried before any other
  std::int64_t start = 1;  ///< tokens: with these depths of all FIFOs the goal is reached
};

/// What a machine with certain depths does.
struct Judgement {
  bool kept = false;  ///< the goal
  /// If so: with these depths, none more than what it has, nothing in its run would be another.
  Depths enough;
};

/// Smallest depths with which a machine reaches a goal: no single FIFO can have a token less.
///
/// The search takes for granted that a deeper FIFO never does harm, which nearly always holds. The proof does
/// not: all depths with one token less in one FIFO are judged, and where the goal is reached, the search goes
/// on from there.
///
/// Several vectors of depths may be smallest. Where of two groups of FIFOs either can be shallower but not
/// both, the one that saves more bits is.
class DepthSearch {
 public:
  /// Judges depths, in their order; throws what ends the search.
  using Judge = std::function<std::vector<Judgement>(const std::vector<Depths>&)>;

  DepthSearch(std::vector<FifoRange> fifos, Judge judge);

  /// The depths found and proven. Empty: the goal is not reached with those to start from.
  Depths find();

 private:
  using Group = std::vector<std::size_t>;  // FIFOs

  struct State {
    std::int64_t depth = 1;   // reaches the goal, with those of all others
    std::int64_t failed = 0;  // does not, as far as is known
    bool tried = false;       // `first` was
    std::int64_t step = 1;    // down from the depth, next time; 0: to the middle of what is left
    bool reopened = false;    // by the proof
  };

  Depths depths() const;
  Depths lowered(const Group& group) const;
  std::int64_t saving(const Group& group) const;
  std::int64_t next(std::size_t fifo) const;
  bool is_far(std::size_t fifo) const;
  Group open(bool far) const;
  void take(const Depths& depths, const Judgement& judgement);
  void fail(std::size_t fifo);
  void lower(bool far);
  std::vector<Group> split(const std::vector<Group>& groups, bool single) const;
  void settle(const Group& group, bool single);
  std::vector<Group> adopt(const std::vector<Group>& good);
  bool proven();

  const std::vector<FifoRange> fifos_;
  const Judge judge_;
  std::vector<State> states_;
  Depths sure_;           // judged, and reached the goal
  bool tightens_ = true;  // Judgement::enough is used
};

}  // namespace parallax
