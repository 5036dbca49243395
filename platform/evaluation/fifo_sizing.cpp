// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/fifo_sizing.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "platform/evaluation/relaxation.hpp"
#include "platform/evaluation/trials.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

using Status = EvaluationResult::Status;

constexpr std::int64_t kFrontParts = 4;  // of the way between two vectors of depths

template <class Member>
Depths depths_of(const std::vector<MachineFifo>& fifos, const Member& member) {
  Depths all;
  for (const MachineFifo& fifo : fifos) all.push_back(member(fifo));
  return all;
}

}  // namespace

Depths deep_depths(const std::vector<MachineFifo>& fifos) {
  return depths_of(fifos,
                   [](const MachineFifo& fifo) { return deep_enough(std::max(fifo.depth, fifo.automatic)); });
}

std::vector<std::string> assignments(const std::vector<MachineFifo>& fifos, const Depths& depths) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < depths.size(); ++i)
    all.push_back(fifos[i].key() + "=" + std::to_string(depths[i]));
  return all;
}

std::int64_t FifoSizing::bits(const Depths& depths) const {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < depths.size(); ++i) sum += depths[i] * fifos[i].width;
  return sum;
}

FifoSizer::FifoSizer(std::vector<MachineFifo> fifos, Evaluate evaluate) : evaluate_(std::move(evaluate)) {
  sizing_.fifos = std::move(fifos);
}

FifoSizing FifoSizer::size(const FifoGoal& goal, const Depths& guess) {
  sizing_.goal = goal;
  const Depths from = start(goal);
  if (from.empty()) return sizing_;
  std::vector<FifoRange> ranges;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const MachineFifo& fifo = sizing_.fifos[i];
    const std::int64_t a_token_a_cycle = std::max<std::int64_t>(1, fifo.write_to_read + fifo.read_to_write);
    const std::int64_t first = goal.kind == FifoGoal::Kind::kDeadlockFree ? 1 : a_token_a_cycle;
    // Less than a guess is the proof's business.
    const std::int64_t least = guess.empty() ? fifo.deadlock_free : guess[i];
    ranges.push_back({fifo.width, least, guess.empty() ? std::max(least, first) : least, from[i]});
  }
  DepthSearch search(ranges, [this](const std::vector<Depths>& all) {
    std::vector<Judgement> judged;
    for (const SizedRun& each : run(all)) {
      const bool kept = reaches(sizing_.goal, each);
      judged.push_back({kept, kept ? enough(each) : Depths{}});
    }
    return judged;
  });
  sizing_.found = run({search.find()}).front();
  prove();
  if (goal.front) sizing_.front = front();
  return sizing_;
}

// Machines on the way from the depths found to those that only avoid a deadlock: those than which no other
// of them is as fast, as quick and as small.
std::vector<SizedRun> FifoSizer::front() {
  longest_frame_ps_ = 0;
  std::vector<Depths> all{sizing_.now.depths};
  for (std::int64_t part = kFrontParts; part >= 0; --part) {
    Depths depths;
    for (std::size_t i = 0; i < sizing_.fifos.size(); ++i) {
      const std::int64_t found = sizing_.found.depths[i];
      const std::int64_t least = std::min(found, sizing_.fifos[i].deadlock_free);
      depths.push_back(least + (found - least) * part / kFrontParts);
    }
    all.push_back(std::move(depths));
  }
  std::vector<SizedRun> points;
  for (const SizedRun& each : run(all)) {
    const auto same = [&](const SizedRun& other) { return other.depths == each.depths; };
    if (each.done && std::none_of(points.begin(), points.end(), same)) points.push_back(each);
  }
  const auto beaten = [&](const SizedRun& point, const SizedRun& by) {
    return by.depths != point.depths && by.period.keeps(point.period, 0) && by.latency <= point.latency &&
           sizing_.bits(by.depths) <= sizing_.bits(point.depths);
  };
  std::vector<SizedRun> front;
  for (const SizedRun& point : points) {
    if (std::none_of(points.begin(), points.end(), [&](const SizedRun& by) { return beaten(point, by); }))
      front.push_back(point);
  }
  return front;
}

// Depths that reach the goal; none: none do. The high-water marks of a run change nothing in it.
Depths FifoSizer::start(const FifoGoal& goal) {
  const Depths now = depths_of(sizing_.fifos, [](const MachineFifo& fifo) { return fifo.depth; });
  const Depths deep = deep_depths(sizing_.fifos);
  Depths free = depths_of(sizing_.fifos, [](const MachineFifo& fifo) { return fifo.deadlock_free; });
  std::vector<Depths> starts{now, deep};
  if (goal.kind == FifoGoal::Kind::kDeadlockFree) starts.push_back(free);
  const std::vector<SizedRun> runs = run(starts);
  sizing_.now = runs[0];
  sizing_.deep = runs[1];
  if (goal.kind == FifoGoal::Kind::kDeadlockFree && runs[2].done) return free;
  longest_frame_ps_ = longest_frame(goal);
  for (const SizedRun& each : {runs[0], runs[1]}) {
    if (!reaches(goal, each)) continue;
    const Depths less = enough(each);
    return reaches(goal, run({less}).front()) ? less : each.depths;
  }
  return {};
}

// Picoseconds; 0: any.
std::int64_t FifoSizer::longest_frame(const FifoGoal& goal) const {
  if (goal.kind == FifoGoal::Kind::kDeadlockFree) return 0;
  if (goal.kind == FifoGoal::Kind::kRate) return static_cast<std::int64_t>(std::ceil(1e12 / goal.rate));
  if (!sizing_.deep.done) return 0;
  return static_cast<std::int64_t>(std::ceil(1e12 / sizing_.deep.period.rate() * (1 + goal.tolerance)));
}

void FifoSizer::prove() {
  std::vector<Depths> all;
  for (std::size_t i = 0; i < sizing_.found.depths.size(); ++i) {
    if (sizing_.found.depths[i] == 1) continue;
    all.push_back(sizing_.found.depths);
    --all.back()[i];
    sizing_.less.push_back(i);
  }
  sizing_.proof = run(all);
  const auto reached = [this](const SizedRun& each) { return reaches(sizing_.goal, each); };
  if (!reached(sizing_.found) || std::any_of(sizing_.proof.begin(), sizing_.proof.end(), reached))
    throw std::logic_error("the depths found are not the smallest");
}

bool FifoSizer::reaches(const FifoGoal& goal, const SizedRun& run) const {
  if (!run.done || goal.by_core || goal.kind == FifoGoal::Kind::kDeadlockFree) return run.done;
  if (goal.kind == FifoGoal::Kind::kRate) return run.period.rate() >= goal.rate;
  return sizing_.deep.done && run.period.keeps(sizing_.deep.period, goal.tolerance);
}

// A slot counts for the writer until it can be written again, so that as many tokens as that takes cycles
// may lie beyond the high-water mark.
Depths FifoSizer::enough(const SizedRun& run) const {
  Depths all;
  for (std::size_t i = 0; i < run.depths.size(); ++i) {
    const std::int64_t slots = run.high_water[i] + sizing_.fifos[i].read_to_write;
    all.push_back(std::max<std::int64_t>(1, std::min(run.depths[i], slots)));
  }
  return all;
}

// Each once.
std::vector<SizedRun> FifoSizer::run(const std::vector<Depths>& all) {
  std::vector<Depths> fresh;
  for (const Depths& depths : all) {
    const auto known = known_.find(depths);
    const bool is_known = known != known_.end() && (!known->second.too_slow || longest_frame_ps_ != 0);
    if (!is_known && std::find(fresh.begin(), fresh.end(), depths) == fresh.end()) fresh.push_back(depths);
  }
  std::vector<std::vector<std::string>> keys;
  for (const Depths& depths : fresh) keys.push_back(assignments(sizing_.fifos, depths));
  const std::vector<EvaluationResult> results =
      fresh.empty() ? std::vector<EvaluationResult>{} : evaluate_(keys, longest_frame_ps_);
  if (results.size() < fresh.size()) throw TrialsEnded();
  sizing_.runs += fresh.size();
  for (std::size_t i = 0; i < fresh.size(); ++i) known_[fresh[i]] = sized(fresh[i], results[i]);
  std::vector<SizedRun> runs;
  for (const Depths& depths : all) runs.push_back(known_.at(depths));
  return runs;
}

SizedRun FifoSizer::sized(const Depths& depths, const EvaluationResult& result) const {
  SizedRun run;
  run.depths = depths;
  if (result.status == Status::kInvalid) throw UserError(result.message);
  if (result.status == Status::kFailed) throw std::runtime_error(result.message);
  if (!result.done()) {
    run.too_slow = result.status == Status::kTooSlow;
    run.message = result.advice();
    return run;
  }
  run.done = true;
  run.period = frame_period(result);
  run.latency = result.latency.exposure_to_host;
  for (const MachineFifo& fifo : sizing_.fifos)
    run.high_water.push_back(result.metrics.count("streams/" + fifo.stream + "/high_water"));
  run.limit = result.limit.part;
  run.limit_key = result.metrics.word_or("limit/key", "");
  return run;
}

}  // namespace parallax
