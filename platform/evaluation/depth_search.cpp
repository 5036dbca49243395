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

// First the guess; if that fails, down from the depth, which may be the least, in steps that grow as long as
// they are kept; then the middle of what is left. The depth itself when nothing is.
std::int64_t DepthSearch::next(std::size_t fifo) const {
  const State& state = states_[fifo];
  const std::int64_t first = fifos_[fifo].first;
  if (!state.tried && first > state.failed && first < state.depth) return first;
  if (state.depth <= state.failed + 1) return state.depth;
  const std::int64_t middle = (state.failed + state.depth) / 2;
  return state.step > 0 && is_far(fifo) ? std::max(middle, state.depth - state.step) : middle;
}

bool DepthSearch::is_far(std::size_t fifo) const {
  return states_[fifo].reopened || states_[fifo].depth > fifos_[fifo].first;
}

// FIFOs with something to try, what saves most first: those that are deeper than their guess, or the others.
DepthSearch::Group DepthSearch::open(bool far) const {
  Group group;
  for (std::size_t i = 0; i < fifos_.size(); ++i) {
    if (next(i) < states_[i].depth && is_far(i) == far) group.push_back(i);
  }
  std::stable_sort(group.begin(), group.end(),
                   [this](std::size_t a, std::size_t b) { return saving({a}) > saving({b}); });
  return group;
}

void DepthSearch::take(const Depths& depths, const Judgement& judgement) {
  sure_ = depths;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    State& state = states_[i];
    if (state.tried && depths[i] < state.depth) state.step *= 2;
    state.tried = state.tried || depths[i] <= fifos_[i].first;
    state.depth = depths[i];
    if (tightens_) state.depth = std::min(state.depth, std::max(judgement.enough[i], state.failed + 1));
  }
}

void DepthSearch::fail(std::size_t fifo) {
  State& state = states_[fifo];
  state.failed = next(fifo);
  if (state.tried) state.step = 0;
  state.tried = true;
}

void DepthSearch::lower(bool far) {
  if (far) {
    for (Group group = open(true); !group.empty(); group = open(true)) settle(group, true);
    return;
  }
  // Those that fail together the proof tries one by one.
  if (const Group group = open(false); !group.empty()) settle(group, false);
}

// Halves of groups that failed; of few FIFOs each alone, if that is wanted.
std::vector<DepthSearch::Group> DepthSearch::split(const std::vector<Group>& groups, bool single) const {
  std::vector<Group> parts;
  for (const Group& group : groups) {
    if (group.size() <= kFew) {
      for (const std::size_t fifo : group) {
        if (single && next(fifo) < states_[fifo].depth) parts.push_back({fifo});
      }
    } else {
      const auto middle = group.begin() + static_cast<std::ptrdiff_t>(group.size() / 2);
      parts.emplace_back(group.begin(), middle);
      parts.emplace_back(middle, group.end());
    }
  }
  return parts;
}

// Finds out which of a group can go where they are to be tried next. `single`: down to each alone.
void DepthSearch::settle(const Group& group, bool single) {
  std::vector<Group> groups{group};
  if (single && group.size() <= kFew) groups = split(groups, true);
  while (!groups.empty()) {
    std::vector<Depths> tried;
    for (const Group& each : groups) tried.push_back(lowered(each));
    const std::vector<Judgement> judged = judge_(tried);
    std::vector<Group> good, bad;
    for (std::size_t i = 0; i < groups.size(); ++i) {
      if (judged[i].kept) {
        good.push_back(groups[i]);
      } else if (groups[i].size() == 1) {
        fail(groups[i].front());
      } else {
        bad.push_back(groups[i]);
      }
    }
    for (Group& each : adopt(good)) bad.push_back(std::move(each));
    groups = split(bad, single);
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
      const std::int64_t least = fifos_[lowered[i]].least;
      state = {state.depth, state.depth > least ? least - 1 : 0, true, 1, true};
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
