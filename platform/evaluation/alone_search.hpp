// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "platform/evaluation/trials.hpp"

namespace parallax {

/// What gains most when it alone is taken away, by branch and bound: a set that gains less together than the
/// best one alone so far holds nothing better, and is not looked into; others are tried in two parts, what is
/// busiest first.
///
/// That taking more away never makes a machine slower is nearly true only: a faster part may meet the memory
/// at a worse moment. Of random machines, sets were up to 1 % slower than one of them alone; so a set is left
/// out only when it is worse than the best one by that, or where that gains less than 2 %, by half of it.
/// What a part that works for a frame as long as before leaves no time to gain is not tried at all.
class AloneSearch {
 public:
  /// Hears of each that was tried alone.
  using Found = std::function<void(const RelaxedLimit&)>;

  /// `besides`: taken away in any case, so that of the others the best one besides these is found.
  AloneSearch(Trials& trials, Found found, std::vector<Relaxation> besides = {})
      : trials_(trials), found_(std::move(found)), besides_(std::move(besides)) {}

  /// `own` are tried alone in any case. Throws TrialsEnded.
  void run(const std::vector<Relaxation>& own, const std::vector<Relaxation>& others);

 private:
  struct Node {
    std::vector<Relaxation> set;  // of two or more
    double gain = 0;              // together
  };

  void branch(const std::vector<std::vector<Relaxation>>& sets);
  double worth_a_look() const;

  Trials& trials_;
  const Found found_;
  const std::vector<Relaxation> besides_;
  std::vector<Node> open_;
  double best_ = 0;  // gain of one alone, %
};

}  // namespace parallax
