// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/wiring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace parallax {

Wiring::Wiring(const StreamConfig& streams, const StageContext& context, StageReplacements replacements)
    : streams_config_(streams), context_(context), replacements_(std::move(replacements)) {}

Wiring::Slot& Wiring::place(const std::string& name, const Facts& facts, const StageFactory& usual) {
  auto replaced = replacements_.find(name);
  if (replaced == replacements_.end()) replaced = replacements_.find(kAllOtherSlots);
  const bool is_usual = replaced == replacements_.end() || !replaced->second;
  const StageFactory& factory = is_usual ? usual : replaced->second;
  auto slot = std::make_unique<Slot>(Slot{name, facts, factory(name, context_), is_usual});
  slot->content.storage += facts.storage;
  slots_.push_back(std::move(slot));
  return *slots_.back();
}

std::size_t Wiring::index(const std::string& slot) const {
  const auto found =
      std::find_if(slots_.begin(), slots_.end(), [&](const auto& each) { return each->name == slot; });
  if (found == slots_.end()) throw std::logic_error(fmt::format("the pipeline has no slot {}", slot));
  return found - slots_.begin();
}

sc_core::sc_object& Wiring::port(const PortName& name) const {
  for (sc_core::sc_object* child : slots_[index(name.slot)]->content.module->get_child_objects()) {
    if (child->basename() == name.port) return *child;
  }
  misfit(name);
}

void Wiring::misfit(const PortName& name) {
  throw std::logic_error(
      fmt::format("what stands in the slot {} has no port {} for the tokens there", name.slot, name.port));
}

std::vector<TokenPort> Wiring::ports(const std::string& slot) const {
  std::vector<TokenPort> all;
  for (const End& end : ends_) {
    if (end.port.slot != slot) continue;
    const auto same = std::find_if(all.begin(), all.end(),
                                   [&](const TokenPort& each) { return each.name == end.port.port; });
    if (same != all.end()) {
      same->streams.push_back(end.stream);
      continue;
    }
    all.push_back(
        {end.port.port,
         end.is_input,
         {end.stream},
         end.shape,
         [is_input = end.is_input, tap = end.tap](const TokenTap::Take& take) { return tap(is_input, take); },
         end.opposite});
  }
  std::stable_partition(all.begin(), all.end(), [](const TokenPort& each) { return each.is_input; });
  return all;
}

void Wiring::build() {
  for (const auto& [name, factory] : replacements_) {
    if (name != kAllOtherSlots && factory) index(name);
  }

  ForkGraph graph;
  for (const auto& slot : slots_) {
    graph.nodes.push_back({slot->content.look_ahead, slot->content.latency, slot->facts.group});
  }
  // What leads upstream comes out of the memory, and so from no fork.
  std::vector<std::size_t> edges;
  for (std::size_t i = 0; i < wires_.size(); ++i) {
    const Wire& wire = wires_[i];
    if (wire.from >= wire.to) continue;
    edges.push_back(i);
    graph.edges.push_back(
        {wire.from, wire.to, streams_config_.offsets(wire.name), wire.groups, wire.reads == Reads::kLate});
  }
  const std::vector<std::uint64_t> needed = fork_depths(graph);
  std::vector<std::uint64_t> depths(wires_.size(), 0);
  for (std::size_t i = 0; i < edges.size(); ++i) depths[edges[i]] = needed[i];

  for (std::size_t i = 0; i < wires_.size(); ++i) {
    const Wire& wire = wires_[i];
    FifoConfig fifo;
    fifo.depth = streams_config_.resolve(wire.name, static_cast<std::uint32_t>(depths[i]));
    fifo.width = wire.width;
    streams_config_.set_kind(wire.name, fifo);
    streams_.push_back(wire.make(wire.name.c_str(), fifo));
  }
}

}  // namespace parallax
