// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace parallax {

/// Tokens one after the other that have as many values each.
struct TokenRun {
  std::uint64_t tokens = 0;  ///< >= 1
  std::size_t values = 0;    ///< of each, >= 1
};

/// Goes through runs of tokens, over and over.
class PlaceInRuns {
 public:
  /// `runs` must outlive it.
  explicit PlaceInRuns(const std::vector<TokenRun>& runs) : runs_(runs) {}

  /// Values of the present token. Needs runs.
  std::size_t size() const { return runs_[run_].values; }
  void next() {
    if (++into_run_ < runs_[run_].tokens) return;
    into_run_ = 0;
    run_ = (run_ + 1) % runs_.size();
  }

 private:
  const std::vector<TokenRun>& runs_;
  std::size_t run_ = 0;
  std::uint64_t into_run_ = 0;  // tokens of it that are behind
};

}  // namespace parallax
