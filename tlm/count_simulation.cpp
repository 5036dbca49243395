// SPDX-License-Identifier: Apache-2.0
#include "tlm/count_simulation.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace parallax {

CountSimulation::CountSimulation(const std::vector<Participant>& stages,
                                 const std::vector<const StreamBase*>& streams) {
  for (const StreamBase* stream : streams) fifos_.push_back({stream->depth()});
  for (const Participant& stage : stages) add(stage, streams);
}

void CountSimulation::add(const Participant& stage, const std::vector<const StreamBase*>& streams) {
  const std::size_t id = programs_.size();
  programs_.push_back({{}, {}, stage.latency, stage.frame_limit});
  positions_.emplace_back();

  // Indices of the streams that are looked at.
  using Ports = std::vector<std::vector<std::size_t>>;
  const auto looked_at = [&](const std::vector<std::vector<const StreamBase*>>& ports) {
    Ports all;
    for (const std::vector<const StreamBase*>& port : ports) {
      all.emplace_back();
      for (const StreamBase* stream : port) {
        const auto found = std::find(streams.begin(), streams.end(), stream);
        if (found != streams.end()) all.back().push_back(found - streams.begin());
      }
    }
    return all;
  };
  const Ports reads = looked_at(stage.inputs);
  const Ports writes = looked_at(stage.outputs);
  unsigned read = 0;  // ports that matter
  unsigned written = 0;
  for (std::size_t port = 0; port < reads.size(); ++port) {
    for (const std::size_t stream : reads[port]) fifos_[stream].reader = id, read |= 1u << port;
  }
  for (std::size_t port = 0; port < writes.size(); ++port) {
    for (const std::size_t stream : writes[port]) fifos_[stream].writer = id, written |= 1u << port;
  }
  // Where something is written, what goes elsewhere takes its slot in the pipeline too. A pipeline that
  // nothing holds up is none.
  if (written != 0 && stage.latency > 0) written = ~0u;

  std::vector<std::size_t> action_of_phase;
  const std::size_t first_action = actions_.size();
  std::vector<std::pair<unsigned, unsigned>> masks;  // of the actions
  const auto append = [&](const Ports& ports, unsigned mask) {
    for (std::size_t port = 0; port < ports.size(); ++port) {
      if (((mask >> port) & 1u) != 0) lists_.insert(lists_.end(), ports[port].begin(), ports[port].end());
    }
    return lists_.size();
  };
  for (const Phase& phase : stage.schedule.phases()) {
    const std::pair<unsigned, unsigned> mask(phase.consume & read, phase.produce & written);
    const auto known = std::find(masks.begin(), masks.end(), mask);
    action_of_phase.push_back(first_action + (known - masks.begin()));
    if (known != masks.end()) continue;
    masks.push_back(mask);
    Action action{};
    action.consume = lists_.size();
    action.consume_end = append(reads, mask.first);
    action.produce = action.consume_end;
    action.produce_end = append(writes, mask.second);
    action.enters = mask.second != 0 && stage.latency > 0;
    actions_.push_back(action);
  }
  load(stage.schedule, action_of_phase);
}

// Leaves out what concerns no stream, and joins neighbours that do the same.
void CountSimulation::load(const Schedule& schedule, const std::vector<std::size_t>& action_of_phase) {
  Program& program = programs_.back();
  for (const Schedule::Segment& segment : schedule.segments()) {
    Segment loaded{segment.repeat, program.runs.size(), 0};
    for (std::uint32_t i = segment.first_phase; i < segment.first_phase + segment.phase_count; ++i) {
      const std::size_t action = action_of_phase[i];
      const Action& does = actions_[action];
      if (does.consume == does.produce_end && !does.enters) continue;
      const std::uint64_t count = schedule.phases()[i].count;
      if (program.runs.size() > loaded.first && program.runs.back().action == action) {
        program.runs.back().count += count;
      } else {
        program.runs.push_back({count, action});
      }
    }
    loaded.runs = program.runs.size() - loaded.first;
    if (loaded.runs == 0) continue;
    if (loaded.runs == 1) {
      loaded.repeat *= std::exchange(program.runs.back().count, 1);
      if (!program.segments.empty() && program.segments.back().runs == 1 &&
          program.runs[program.segments.back().first].action == program.runs.back().action) {
        program.segments.back().repeat += loaded.repeat;
        program.runs.pop_back();
        continue;
      }
    }
    program.segments.push_back(loaded);
  }
}

bool CountSimulation::run(std::uint64_t frames) {
  for (;;) {
    bool moved = false;
    for (std::size_t stage = 0; stage < programs_.size(); ++stage) moved |= advance(stage);
    if (complete(frames)) return true;
    if (!moved) return false;
    if (repeats_for_ever()) return true;
  }
}

bool CountSimulation::ended(std::size_t stage) const {
  const Program& program = programs_[stage];
  return program.segments.empty() ||
         (program.frame_limit != 0 && positions_[stage].frames == program.frame_limit);
}

bool CountSimulation::complete(std::uint64_t frames) const {
  for (std::size_t stage = 0; stage < programs_.size(); ++stage) {
    if (positions_[stage].frames < frames && !ended(stage)) return false;
  }
  return true;
}

bool CountSimulation::advance(std::size_t stage) {
  bool moved = false;
  while (drain(stage) || fire(stage)) moved = true;
  return moved;
}

std::uint64_t CountSimulation::room(const Action& action) const {
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
  for (std::size_t i = action.produce; i < action.produce_end; ++i) {
    const Fifo& fifo = fifos_[lists_[i]];
    least = std::min(least, fifo.depth - fifo.held);
  }
  return least;
}

// As many equal firings as can follow one another.
bool CountSimulation::fire(std::size_t stage) {
  if (ended(stage)) return false;
  const Program& program = programs_[stage];
  Position& at = positions_[stage];
  const Segment& segment = program.segments[at.segment];
  const Run& run = program.runs[segment.first + at.run];
  const Action& action = actions_[run.action];
  std::uint64_t firings = segment.runs == 1 ? segment.repeat - at.repetition : run.count - at.done;
  for (std::size_t i = action.consume; i < action.consume_end; ++i) {
    firings = std::min(firings, fifos_[lists_[i]].held);
  }
  firings = std::min(firings, action.enters ? program.latency - at.piped : room(action));
  if (firings == 0) return false;
  for (std::size_t i = action.consume; i < action.consume_end; ++i) fifos_[lists_[i]].held -= firings;
  if (action.enters) {
    at.piped += firings;
    if (!at.pipe.empty() && at.pipe.back().action == run.action) {
      at.pipe.back().count += firings;
    } else {
      at.pipe.push_back({firings, run.action});
    }
  } else {
    for (std::size_t i = action.produce; i < action.produce_end; ++i) fifos_[lists_[i]].held += firings;
  }
  step(stage, firings);
  return true;
}

// Lets firings leave the pipeline.
bool CountSimulation::drain(std::size_t stage) {
  Position& at = positions_[stage];
  if (at.pipe.empty()) return false;
  Run& first = at.pipe.front();
  const Action& action = actions_[first.action];
  const std::uint64_t firings = std::min(first.count, room(action));
  if (firings == 0) return false;
  for (std::size_t i = action.produce; i < action.produce_end; ++i) fifos_[lists_[i]].held += firings;
  at.piped -= firings;
  first.count -= firings;
  if (first.count == 0) at.pipe.erase(at.pipe.begin());
  return true;
}

void CountSimulation::step(std::size_t stage, std::uint64_t firings) {
  const Program& program = programs_[stage];
  Position& at = positions_[stage];
  const Segment& segment = program.segments[at.segment];
  if (segment.runs == 1) {
    at.repetition += firings;
  } else {
    at.done += firings;
    if (at.done < program.runs[segment.first + at.run].count) return;
    at.done = 0;
    if (++at.run < segment.runs) return;
    at.run = 0;
    ++at.repetition;
  }
  if (at.repetition < segment.repeat) return;
  at.repetition = 0;
  ++segments_begun_;
  if (++at.segment < program.segments.size()) return;
  at.segment = 0;
  ++at.frames;
}

// Whether the present state is the one kept.
bool CountSimulation::returns(Recurrence& recurrence, Within within) {
  state_.clear();
  for (const Fifo& fifo : fifos_) state_.push_back(fifo.held);
  for (const Position& at : positions_) {
    state_.insert(state_.end(), {at.run, at.done, at.pipe.size()});
    for (const Run& run : at.pipe) state_.insert(state_.end(), {run.count, run.action});
    if (within == Within::kFrames) state_.insert(state_.end(), {at.segment, at.repetition});
  }
  if (state_ == recurrence.kept) return true;
  if (++recurrence.age == recurrence.oldest) {
    recurrence.age = 0;
    recurrence.oldest *= 2;
    recurrence.kept = state_;
    recurrence.positions = positions_;
  }
  return false;
}

// What the stages do in a round depends on the state only, so what has followed a state follows it again:
// within segments, periods are gone through at once; from frame to frame, a period is enough if all stages
// move in it.
bool CountSimulation::repeats_for_ever() {
  if (positions_.front().frames != frames_seen_) {
    frames_seen_ = positions_.front().frames;
    if (returns(in_frames_, Within::kFrames)) {
      bool all_move = true;
      for (std::size_t stage = 0; stage < programs_.size(); ++stage) {
        all_move &= ended(stage) || positions_[stage].frames != in_frames_.positions[stage].frames;
      }
      if (all_move) return true;
    }
  }
  if (segments_begun_ != segments_seen_) {
    segments_seen_ = segments_begun_;
    in_segments_ = {};
  } else if (returns(in_segments_, Within::kSegments)) {
    leap();
    in_segments_ = {};
  }
  return false;
}

// Repeats what has happened since the kept state as often as no stage gets to the end of its segment by it.
void CountSimulation::leap() {
  std::uint64_t periods = std::numeric_limits<std::uint64_t>::max();
  const auto repetitions = [&](std::size_t stage) {
    return positions_[stage].repetition - in_segments_.positions[stage].repetition;
  };
  for (std::size_t stage = 0; stage < programs_.size(); ++stage) {
    if (repetitions(stage) == 0) continue;
    const std::uint64_t left =
        programs_[stage].segments[positions_[stage].segment].repeat - positions_[stage].repetition;
    periods = std::min(periods, (left - 1) / repetitions(stage));
  }
  for (std::size_t stage = 0; stage < programs_.size(); ++stage) {
    positions_[stage].repetition += periods * repetitions(stage);
  }
}

std::vector<CountSimulation::Need> CountSimulation::needs() const {
  std::vector<Need> all;
  const auto need_room = [&](std::size_t node, const Action& action) {
    for (std::size_t i = action.produce; i < action.produce_end; ++i) {
      const Fifo& fifo = fifos_[lists_[i]];
      if (fifo.held == fifo.depth) all.push_back({node, 2 * fifo.reader, lists_[i]});
    }
  };
  for (std::size_t stage = 0; stage < programs_.size(); ++stage) {
    const std::size_t firing = 2 * stage;
    const std::size_t leaving = firing + 1;
    const Position& at = positions_[stage];
    if (at.pipe.empty()) {
      all.push_back({leaving, firing, kNone});
    } else {
      need_room(leaving, actions_[at.pipe.front().action]);
    }
    if (ended(stage)) continue;
    const Program& program = programs_[stage];
    const Action& action = actions_[program.runs[program.segments[at.segment].first + at.run].action];
    for (std::size_t i = action.consume; i < action.consume_end; ++i) {
      const Fifo& fifo = fifos_[lists_[i]];
      if (fifo.held == 0) all.push_back({firing, 2 * fifo.writer + 1, kNone});
    }
    if (!action.enters) {
      need_room(firing, action);
    } else if (at.piped == program.latency) {
      all.push_back({firing, leaving, kNone});
    }
  }
  return all;
}

void CountSimulation::set_depth(std::size_t stream, std::uint32_t depth) {
  fifos_[stream].depth = depth;
  in_segments_ = {};
  in_frames_ = {};
}

}  // namespace parallax
