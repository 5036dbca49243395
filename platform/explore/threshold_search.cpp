// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/threshold_search.hpp"

#include <algorithm>
#include <utility>

namespace parallax {
namespace {

// The first step away from the start, as a part of all numbers.
constexpr std::size_t kFirstStep = 16;

class Search {
 public:
  using Numbers = std::vector<std::size_t>;
  using Hold = std::function<std::vector<bool>(const Numbers&)>;

  Search(std::size_t size, std::size_t at_once, const Hold& hold)
      : size_(size),
        at_once_(std::max<std::size_t>(at_once, 1)),
        hold_(hold),
        step_(std::max<std::size_t>(1, size / kFirstStep)) {}

  Threshold run(std::size_t start) {
    if (size_ == 0) return {true, {}};
    for (Numbers next{std::min(start, size_ - 1)}; !next.empty(); next = next_numbers()) {
      if (!try_out(next)) return {};
    }
    return {true, holds_};
  }

 private:
  // None when the threshold is found.
  Numbers next_numbers() {
    if (!holds_) return upwards();
    if (!fails_) return downwards();
    return sections();
  }

  Numbers upwards() {
    Numbers up;
    for (std::size_t at = *fails_; up.size() < at_once_ && at < size_ - 1; step_ *= 2) {
      at = std::min(at + step_, size_ - 1);
      up.push_back(at);
    }
    return up;
  }

  Numbers downwards() {
    Numbers down;
    for (std::size_t at = *holds_; down.size() < at_once_ && at > 0; step_ *= 2) {
      at -= std::min(at, step_);
      down.insert(down.begin(), at);
    }
    return down;
  }

  // The gap in equal parts.
  Numbers sections() const {
    const std::size_t gap = *holds_ - *fails_;
    const std::size_t cuts = std::min(at_once_, gap - 1);
    Numbers tried;
    for (std::size_t i = 1; i <= cuts; ++i) tried.push_back(*fails_ + gap * i / (cuts + 1));
    return tried;
  }

  // Ascending: the first that holds counts, and the one before it.
  bool try_out(const Numbers& numbers) {
    const std::vector<bool> answers = hold_(numbers);
    if (answers.size() < numbers.size()) return false;
    const auto first =
        static_cast<std::size_t>(std::find(answers.begin(), answers.end(), true) - answers.begin());
    if (first < numbers.size()) holds_ = numbers[first];
    if (first > 0) fails_ = numbers[first - 1];
    return true;
  }

  const std::size_t size_;
  const std::size_t at_once_;
  const Hold& hold_;
  std::size_t step_;
  std::optional<std::size_t> fails_;  // the largest number that is known not to hold
  std::optional<std::size_t> holds_;  // the least that is known to hold
};

}  // namespace

Threshold find_threshold(std::size_t size, std::size_t start, std::size_t at_once,
                         const std::function<std::vector<bool>(const std::vector<std::size_t>&)>& hold) {
  return Search(size, at_once, hold).run(start);
}

}  // namespace parallax
