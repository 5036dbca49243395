// SPDX-License-Identifier: Apache-2.0
#include "platform/tracing/run_profile.hpp"

#include <string>

namespace parallax {
namespace {

RecorderConfig config_of(const Machine& machine) {
  RecorderConfig config;
  config.rows = machine.input().height;
  config.tiles = static_cast<std::int32_t>(machine.tiles().tiles.size());
  config.frames = machine.input().frames;
  config.period =
      sc_core::sc_time(1, sc_core::SC_MS);  // what has been told until then is kept, a few rows of each port
  return config;
}

nlohmann::ordered_json counts(const LatencyHistogram& histogram) {
  auto bounds = nlohmann::ordered_json::array();
  auto numbers = nlohmann::ordered_json::array();
  for (const auto& [bound, count] : histogram.counts()) {
    bounds.push_back(bound.value());
    numbers.push_back(count);
  }
  return {{"unit", "ps"}, {"at_most", bounds}, {"count", numbers}};
}

}  // namespace

RunProfile::RunProfile(const Machine& machine, SamplingTimer& timer)
    : machine_(machine),
      frame_(std::make_shared<FrameProfile>(machine.map_port().name)),
      order_(frame_),
      recorder_("profile", config_of(machine), const_cast<Dataflow&>(machine.dataflow()), timer, [this] {
        for (const MemoryPort* port : machine_.ports()) recorder_.add(*port->master, port->name, port->rows);
      }) {
  recorder_.add(order_);
}

nlohmann::ordered_json RunProfile::to_json() const {
  nlohmann::ordered_json tree{{"frame", frame_->to_json()}};
  for (std::size_t i = 0; i < frame_spans().size(); ++i) {
    tree["latency"][frame_spans()[i].name] = counts(machine_.latencies().steady(i));
  }
  for (const MemoryPort* port : machine_.ports())
    tree["latency"][port->name] = counts(port->master->latencies());
  return tree;
}

}  // namespace parallax
