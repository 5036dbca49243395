// SPDX-License-Identifier: Apache-2.0
#include "tlm/deadlock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>
#include <tuple>

#include "tlm/count_simulation.hpp"
#include "tlm/stage.hpp"
#include "tlm/stream.hpp"

namespace parallax {
namespace {

using Arc = std::pair<std::size_t, std::size_t>;
using Need = CountSimulation::Need;

constexpr std::size_t kNone = CountSimulation::kNone;

// Nodes of a stage (CountSimulation::Need).
std::size_t firing(std::size_t stage) { return 2 * stage; }
std::size_t leaving(std::size_t stage) { return 2 * stage + 1; }

class Names {
 public:
  std::size_t number(const std::string& name) {
    const auto known = std::find(names_.begin(), names_.end(), name);
    if (known == names_.end()) return names_.push_back(name), names_.size() - 1;
    return known - names_.begin();
  }
  std::size_t size() const { return names_.size(); }
  const std::string& operator[](std::size_t i) const { return names_[i]; }

 private:
  std::vector<std::string> names_;
};

// Streams that lie on circles, whichever way tokens run, and who is at their ends. A deadlock never leaves
// it: no circle of waits passes a stream that is the only connection between two parts.
struct Part {
  std::vector<const StreamBase*> streams;
  std::vector<CountSimulation::Participant> stages;
  std::string outsider;  // a module whose schedule is not known
};

// A module in kernel time with a single port, for its streams to bring or take whatever can be.
std::optional<CountSimulation::Participant> end_of_graph(const std::string& name) {
  CountSimulation::Participant end;
  const sc_core::sc_object* module = sc_core::sc_find_object(name.c_str());
  if (module == nullptr) return std::nullopt;
  for (sc_core::sc_object* child : module->get_child_objects()) {
    auto* port = dynamic_cast<StreamPort*>(child);
    if (port == nullptr) continue;
    const std::vector<StreamBase*> streams = port->streams();
    (port->is_input() ? end.inputs : end.outputs).emplace_back(streams.begin(), streams.end());
  }
  if (end.inputs.size() + end.outputs.size() != 1) return std::nullopt;
  end.schedule.run(fires().reads(end.inputs.empty() ? 0 : 1).writes(end.outputs.empty() ? 0 : 1));
  return end;
}

CountSimulation::Participant participant(const Stage& stage) {
  CountSimulation::Participant all{stage.schedule(), stage.latency(), stage.frame_limit(), {}, {}};
  for (unsigned port = 0; port < Stage::kMaxPorts; ++port) {
    all.inputs.push_back(stage.input_streams(port));
    all.outputs.push_back(stage.output_streams(port));
  }
  return all;
}

// Which nodes hang together over those arcs that are not left out: a number for each.
std::vector<std::size_t> connected(std::size_t nodes, const std::vector<Arc>& arcs,
                                   const std::vector<bool>& left_out) {
  std::vector<std::size_t> group(nodes);
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const std::size_t from = group[arcs[i].first];
    const std::size_t to = group[arcs[i].second];
    if (!left_out[i] && from != to) std::replace(group.begin(), group.end(), from, to);
  }
  return group;
}

std::vector<Part> parts(const Dataflow& dataflow) {
  Names names;
  std::vector<const Actor*> actors;
  std::vector<Arc> arcs;
  const auto node = [&](const std::string& name, const Actor* actor) {
    const std::size_t id = names.number(name);
    actors.resize(names.size());
    actors[id] = actor;
    return id;
  };
  for (const StreamBase* stream : dataflow.streams()) {
    const std::size_t writer = node(stream->writer_name(), stream->writer());
    arcs.emplace_back(writer, node(stream->reader_name(), stream->reader()));
  }
  std::vector<bool> only(arcs.size(), false);  // connections between two parts
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    std::vector<bool> this_one(arcs.size(), false);
    this_one[i] = true;
    const std::vector<std::size_t> group = connected(names.size(), arcs, this_one);
    only[i] = group[arcs[i].first] != group[arcs[i].second];
  }
  const std::vector<std::size_t> group = connected(names.size(), arcs, only);
  std::vector<Part> all(names.size());
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    if (!only[i]) all[group[arcs[i].first]].streams.push_back(dataflow.streams()[i]);
  }
  const auto join = [&](bool stages) {
    for (std::size_t id = 0; id < names.size(); ++id) {
      Part& part = all[group[id]];
      const auto* stage = dynamic_cast<const Stage*>(actors[id]);
      if (part.streams.empty() || (stage != nullptr) != stages) continue;
      std::optional<CountSimulation::Participant> known;
      if (stage != nullptr) known = participant(*stage);
      if (actors[id] == nullptr) known = end_of_graph(names[id]);
      if (known) part.stages.push_back(*known);
      if (!known) part.outsider = names[id];
    }
  };
  join(true);  // first, since their frames are those that count
  join(false);
  const auto empty = [](const Part& part) { return part.streams.empty(); };
  all.erase(std::remove_if(all.begin(), all.end(), empty), all.end());
  return all;
}

// The streams of a circle of needs that need room; nothing when there is no circle.
std::optional<std::vector<std::size_t>> circle(const std::vector<Need>& needs) {
  std::vector<Arc> arcs;
  for (const Need& need : needs) arcs.emplace_back(need.from, need.to);
  const std::vector<std::size_t> closed = closed_circle(arcs);
  if (closed.empty()) return std::nullopt;
  std::vector<std::size_t> full;
  for (const std::size_t i : closed) {
    if (needs[i].full != kNone) full.push_back(needs[i].full);
  }
  return full;
}

// Finds depths for one part.
class Search {
 public:
  Search(const Part& part, std::uint64_t frames)
      : part_(part), frames_(frames), start_(part.stages, part.streams), stuck_(start_) {}

  Remedy result() {
    const std::optional<std::vector<std::size_t>> full = go_on(stuck_);
    if (!full) return {};
    std::optional<Depth> cheapest;
    for (const std::size_t stream : *full) {
      const std::optional<Depth> depth = raise(stuck_, stream);
      if (depth && (!cheapest || cost(*depth) < cost(*cheapest))) cheapest = depth;
    }
    if (cheapest) return remedy({*cheapest});
    return several();
  }

 private:
  struct Depth {
    std::size_t stream;
    std::uint32_t tokens;
  };

  std::uint32_t present(std::size_t stream) const { return part_.streams[stream]->depth(); }
  std::tuple<std::int64_t, std::uint32_t> cost(const Depth& depth) const {
    const std::uint32_t more = depth.tokens - present(depth.stream);
    return {part_.streams[depth.stream]->width().count() * more, more};
  }

  Remedy remedy(const std::vector<Depth>& depths) const {
    Remedy found;
    for (const Depth& depth : depths) found.depths.push_back({part_.streams[depth.stream], depth.tokens});
    return found;
  }

  // The full FIFOs of the circle in which the graph is stuck at last, or nothing when it gets through.
  // (What has stopped without a circle has no more input.)
  std::optional<std::vector<std::size_t>> go_on(CountSimulation& graph) const {
    if (graph.run(frames_)) return std::nullopt;
    std::optional<std::vector<std::size_t>> full = circle(graph.needs());
    const auto inside = [this](std::size_t stream) { return part_.streams[stream]->inside_stage(); };
    if (full) full->erase(std::remove_if(full->begin(), full->end(), inside), full->end());
    return full;
  }

  // The smallest depth of one stream that frees a stuck graph, if there is one. More room undoes nothing that
  // has happened, so the graph goes on from where it is stuck.
  std::optional<Depth> raise(CountSimulation graph, std::size_t stream) const {
    while (graph.depth(stream) < StreamBase::kLargestDepth) {
      std::vector<Need> needs = graph.needs();
      const auto freed = [&](const Need& need) { return need.full == stream; };
      needs.erase(std::remove_if(needs.begin(), needs.end(), freed), needs.end());
      if (circle(needs)) return std::nullopt;
      graph.set_depth(stream, graph.depth(stream) + 1);
      if (!go_on(graph)) return Depth{stream, graph.depth(stream)};
    }
    return std::nullopt;
  }

  // Raises the narrowest stream of each circle met, then takes back what was too much.
  Remedy several() const {
    CountSimulation graph = stuck_;
    std::vector<std::size_t> raised;
    while (const std::optional<std::vector<std::size_t>> full = go_on(graph)) {
      std::optional<std::size_t> narrowest;
      for (const std::size_t stream : *full) {
        if (graph.depth(stream) == StreamBase::kLargestDepth) continue;
        if (!narrowest || part_.streams[stream]->width() < part_.streams[*narrowest]->width())
          narrowest = stream;
      }
      if (!narrowest) {
        Remedy none;
        none.obstacle = full->empty()
                            ? "nobody in the circle waits for room"
                            : fmt::format("not even {} tokens in each FIFO help", StreamBase::kLargestDepth);
        return none;
      }
      graph.set_depth(*narrowest, graph.depth(*narrowest) + 1);
      if (std::find(raised.begin(), raised.end(), *narrowest) == raised.end()) raised.push_back(*narrowest);
    }
    CountSimulation least = start_;
    for (const std::size_t stream : raised) least.set_depth(stream, graph.depth(stream));
    std::vector<Depth> depths;
    for (const std::size_t stream : raised) {
      least.set_depth(stream, present(stream));
      CountSimulation lowered = least;
      if (!go_on(lowered)) continue;  // needs no raise at all
      const Depth depth = *raise(lowered, stream);
      least.set_depth(stream, depth.tokens);
      depths.push_back(depth);
    }
    return remedy(depths);
  }

  const Part& part_;
  const std::uint64_t frames_;
  const CountSimulation start_;
  CountSimulation stuck_;
};

}  // namespace

std::vector<std::size_t> closed_circle(const std::vector<Arc>& arcs) {
  std::size_t nodes = 0;
  for (const Arc& arc : arcs) nodes = std::max({nodes, arc.first + 1, arc.second + 1});
  // Depth-first along "waits for".
  std::vector<std::size_t> path;
  std::vector<bool> done(nodes, false);
  const std::function<bool(std::size_t)> closes = [&](std::size_t node) {
    const auto seen =
        std::find_if(path.begin(), path.end(), [&](std::size_t i) { return arcs[i].first == node; });
    if (seen != path.end()) {
      path.erase(path.begin(), seen);
      return true;
    }
    if (done[node]) return false;
    for (std::size_t i = 0; i < arcs.size(); ++i) {
      if (arcs[i].first != node) continue;
      path.push_back(i);
      if (closes(arcs[i].second)) return true;
      path.pop_back();
    }
    done[node] = true;
    return false;
  };
  for (const Arc& arc : arcs) {
    if (closes(arc.first)) return path;
  }
  return {};
}

// A stage is two nodes, its next firing and the first one in its pipeline, since a token that others wait for
// may be in the pipeline already, so that what the next firing waits for is not what keeps it from them.
std::vector<Wait> closed_circle(const std::vector<Wait>& all) {
  Names names;
  std::vector<Arc> arcs;
  std::vector<bool> has_empty;
  std::vector<bool> has_full;
  for (const Wait& wait : all) {
    const std::size_t waiter = names.number(wait.waiter);
    const std::size_t other = names.number(wait.other);
    has_empty.resize(names.size());
    has_full.resize(names.size());
    (wait.on_full ? has_full : has_empty)[waiter] = true;
    arcs.push_back(wait.on_full ? Arc(leaving(waiter), firing(other)) : Arc(firing(waiter), leaving(other)));
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (has_full[i] && !has_empty[i]) arcs.emplace_back(firing(i), leaving(i));  // the pipeline is full
    if (has_empty[i] && !has_full[i]) arcs.emplace_back(leaving(i), firing(i));  // it is empty
  }
  std::vector<Wait> circle;
  for (const std::size_t i : closed_circle(arcs)) {
    if (i < all.size()) circle.push_back(all[i]);
  }
  return circle;
}

Remedy smallest_remedy(const Dataflow& dataflow, std::uint64_t frames) {
  Remedy all;
  const std::vector<Wait> waits = dataflow.deadlock();
  for (const Part& part : parts(dataflow)) {
    const auto within = [&](const Wait& wait) {
      return std::find(part.streams.begin(), part.streams.end(), wait.stream) != part.streams.end();
    };
    Remedy remedy;
    if (part.outsider.empty()) {
      remedy = Search(part, frames).result();
    } else if (std::any_of(waits.begin(), waits.end(), within)) {
      remedy.obstacle =
          fmt::format("{} takes part, and no schedule says what it reads and writes", part.outsider);
    }
    all.depths.insert(all.depths.end(), remedy.depths.begin(), remedy.depths.end());
    if (all.obstacle.empty()) all.obstacle = remedy.obstacle;
  }
  if (!all.obstacle.empty()) all.depths.clear();
  return all;
}

}  // namespace parallax
