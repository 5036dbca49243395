// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/bounds_search.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

namespace parallax {
namespace {

class BoundsSearch {
 public:
  using Numbers = std::vector<std::size_t>;
  using Failed = std::function<std::vector<FailedBounds>(const Numbers&)>;

  BoundsSearch(std::size_t size, std::size_t at_once, const Failed& failed)
      : size_(size), at_once_(std::max<std::size_t>(at_once, 1)), failed_(failed) {}

  Threshold run(std::size_t start) {
    const Threshold upwards = threshold(size_, start);
    if (!upwards.complete || upwards.at || size_ == 0) return upwards;
    if (!try_out({0})) return {};
    for (Numbers cuts; !first_held() && !(cuts = cuts_of_first_gap()).empty();) {
      if (!try_out(cuts)) return {};
    }
    const std::optional<std::size_t> held = first_held();
    return held ? threshold(*held + 1, *held) : Threshold{true, {}};
  }

 private:
  Threshold threshold(std::size_t size, std::size_t start) {
    return find_threshold(size, start, at_once_, [this](const Numbers& numbers) {
      std::vector<bool> answers;
      if (!try_out(numbers)) return answers;
      for (const std::size_t number : numbers) answers.push_back(tried_.at(number).empty());
      return answers;
    });
  }

  // What was tried is known. Whether there were all answers.
  bool try_out(const Numbers& numbers) {
    Numbers unknown;
    for (const std::size_t number : numbers) {
      if (tried_.count(number) == 0) unknown.push_back(number);
    }
    if (unknown.empty()) return true;
    std::vector<FailedBounds> answers = failed_(unknown);
    if (answers.size() < unknown.size()) return false;
    for (std::size_t i = 0; i < unknown.size(); ++i) tried_[unknown[i]] = std::move(answers[i]);
    return true;
  }

  std::optional<std::size_t> first_held() const {
    for (const auto& [number, failed] : tried_) {
      if (failed.empty()) return number;
    }
    return std::nullopt;
  }

  // A bound that fails on both sides of a gap fails in it, too.
  Numbers cuts_of_first_gap() const {
    for (auto below = tried_.begin(); std::next(below) != tried_.end(); ++below) {
      const auto above = std::next(below);
      const std::size_t gap = above->first - below->first;
      if (gap < 2 || share_one(below->second, above->second)) continue;
      const std::size_t cuts = std::min(at_once_, gap - 1);
      Numbers all;
      for (std::size_t i = 1; i <= cuts; ++i) all.push_back(below->first + gap * i / (cuts + 1));
      return all;
    }
    return {};
  }

  static bool share_one(const FailedBounds& a, const FailedBounds& b) {
    return std::any_of(a.begin(), a.end(),
                       [&b](std::size_t bound) { return std::find(b.begin(), b.end(), bound) != b.end(); });
  }

  const std::size_t size_;
  const std::size_t at_once_;
  const Failed& failed_;
  std::map<std::size_t, FailedBounds> tried_;
};

}  // namespace

Threshold find_bounds(
    std::size_t size, std::size_t start, std::size_t at_once,
    const std::function<std::vector<FailedBounds>(const std::vector<std::size_t>&)>& failed) {
  return BoundsSearch(size, at_once, failed).run(start);
}

}  // namespace parallax
