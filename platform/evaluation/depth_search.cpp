// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/depth_search.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace parallax {
namespace {

// Groups of so many FIFOs and fewer are not split, but tried one by one.
constexpr std::size_t kFew = 4;

}  // namespace

DepthSearch::DepthSearch(std::vector<FifoRange> fifos, Judge judge)
    : fifos_(std::move(fifos)), judge_(std::move(judge)), states_(fifos_.size()) {}

Depths DepthSearch::find() {
  for (std::size_t i = 0; i < fifos_.size(); ++i) {
    states_[i].depth = fifos_[i].start;
    states_[i].failed = std::min(fifos_[i].least, fifos_[i].start) - 1;
  }
  const Depths start = depths();
  const Judgement judgement = judge_({start}).front();
  if (!judgement.kept) return {};
  take(start, judgement);
  do {
    lower(true);
    lower(false);
  } while (!proven());
  return depths();
}

Depths DepthSearch::depths() const {
  Depths all;
  for (const State& state : states_) all.push_back(state.depth);
  return all;
}

// With those of a group at what is tried next.
Depths DepthSearch::lowered(const Group& group) const {
  Depths all = depths();
  for (const std::size_t fifo : group) all[fifo] = next(fifo);
  return all;
}

std::int64_t DepthSearch::saving(const Group& group) const {
  return std::accumulate(group.begin(), group.end(), std::int64_t{0},
                         [this](std::int64_t sum, std::size_t i) {
                           return sum + fifos_[i].width * (states_[i].depth - next(i));
                         });
}

// First the guess, then the middle of what is left; the depth itself when nothing is.
std::int64_t DepthSearch::next(std::size_t fifo) const {
  const State& state = states_[fifo];
  const std::int64_t first = fifos_[fifo].first;
  if (!state.tried && first > state.failed && first < state.depth) return first;
  return state.depth <= state.failed + 1 ? state.depth : (state.failed + state.depth) / 2;
}

// FIFOs with something to try, what saves most first: those that are deeper than their guess, or the others.
DepthSearch::Group DepthSearch::open(bool far) const {
  Group group;
  for (std::size_t i = 0; i < fifos_.size(); ++i) {
    if (next(i) < states_[i].depth && (states_[i].depth > fifos_[i].first) == far) group.push_back(i);
  }
  std::stable_sort(group.begin(), group.end(),
                   [this](std::size_t a, std::size_t b) { return saving({a}) > saving({b}); });
  return group;
}

void DepthSearch::take(const Depths& depths, const Judgement& judgement) {
  sure_ = depths;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    State& state = states_[i];
    state.tried = state.tried || depths[i] <= fifos_[i].first;
    state.depth = depths[i];
    if (tightens_) state.depth = std::min(state.depth, std::max(judgement.enough[i], state.failed + 1));
  }
}

void DepthSearch::fail(std::size_t fifo) {
  State& state = states_[fifo];
  state.failed = next(fifo);
  state.tried = true;
}

void DepthSearch::lower(bool far) {
  if (far) {
    for (Group group = open(true); !group.empty(); group = open(true)) settle(group, true);
    return;
  }
  // One by one, the proof tries them.
  if (const Group group = open(false); !group.empty()) settle(group, false);
}

// Finds out which of a group can go where they are to be tried next. `single`: down to each alone.
void DepthSearch::settle(const Group& group, bool single) {
  std::vector<Group> groups{group};
  while (!groups.empty()) {
    std::vector<Depths> tried;
    for (const Group& each : groups) tried.push_back(lowered(each));
    const std::vector<Judgement> judged = judge_(tried);
    std::vector<Group> good, bad;
    for (std::size_t i = 0; i < groups.size(); ++i) (judged[i].kept ? good : bad).push_back(groups[i]);
    std::vector<std::pair<std::size_t, std::int64_t>> failed;
    for (const Group& each : bad) {
      if (each.size() == 1) fail(each.front());
    }
    bad.erase(std::remove_if(bad.begin(), bad.end(), [](const Group& each) { return each.size() == 1; }),
              bad.end());
    for (Group& each : adopt(good)) bad.push_back(std::move(each));
    groups.clear();
    for (const Group& each : bad) {
      if (each.size() <= kFew) {
        for (const std::size_t fifo : each) {
          if (single && next(fifo) < states_[fifo].depth) groups.push_back({fifo});
        }
        continue;
      }
      const auto middle = each.begin() + static_cast<std::ptrdiff_t>(each.size() / 2);
      groups.emplace_back(each.begin(), middle);
      groups.emplace_back(middle, each.end());
    }
  }
}

// Groups each of which can be lowered: all of them, or else the one that saves most. Returns the others.
std::vector<DepthSearch::Group> DepthSearch::adopt(const std::vector<Group>& good) {
  if (good.empty()) return {};
  Group all;
  for (const Group& each : good) all.insert(all.end(), each.begin(), each.end());
  const Depths together = lowered(all);
  // That of a single group is known, so it costs nothing to judge it again.
  if (const Judgement judgement = judge_({together}).front(); judgement.kept) {
    take(together, judgement);
    return {};
  }
  const auto most = std::max_element(
      good.begin(), good.end(), [this](const Group& a, const Group& b) { return saving(a) < saving(b); });
  const Depths lowest = lowered(*most);
  take(lowest, judge_({lowest}).front());
  std::vector<Group> others;
  for (auto each = good.begin(); each != good.end(); ++each) {
    if (each != most) others.push_back(*each);
  }
  return others;
}

// Judges the depths, and all with one token less in one FIFO. Where that reaches the goal, goes there and
// says no.
bool DepthSearch::proven() {
  const Depths found = depths();
  std::vector<Depths> tried{found};
  Group lowered;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i] == 1) continue;
    lowered.push_back(i);
    tried.push_back(found);
    --tried.back()[i];
  }
  const std::vector<Judgement> judged = judge_(tried);
  if (!judged.front().kept) {
    tightens_ = false;
    take(Depths(sure_), {});
    return false;
  }
  std::vector<Group> good;
  for (std::size_t i = 0; i < lowered.size(); ++i) {
    State& state = states_[lowered[i]];
    if (judged[i + 1].kept) {
      state = {state.depth, 0, true};
      good.push_back({lowered[i]});
    } else {
      state.failed = state.depth - 1;
    }
  }
  if (good.empty()) return true;
  Depths less = found;
  for (const Group& each : good) --less[each.front()];
  Judgement judgement = judge_({less}).front();
  if (!judgement.kept) {
    const auto widest = std::max_element(good.begin(), good.end(), [this](const Group& a, const Group& b) {
      return fifos_[a.front()].width < fifos_[b.front()].width;
    });
    less = found;
    --less[widest->front()];
    judgement = judge_({less}).front();
  }
  take(less, judgement);
  return false;
}

}  // namespace parallax
