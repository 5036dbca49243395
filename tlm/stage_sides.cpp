// SPDX-License-Identifier: Apache-2.0
// What a stage of two sides is made of (StageSchedule).
#include <fmt/format.h>

#include <memory>
#include <utility>

#include "tlm/stage.hpp"

namespace parallax {
namespace {

PortMask ports_of(const Schedule& schedule, PortMask Phase::*way) {
  unsigned mask = 0;
  for (const Phase& phase : schedule.phases()) mask |= phase.*way;
  return static_cast<PortMask>(mask);
}

}  // namespace

// It has no ports of its own: the reading side shares its ports with it.
class Stage::WritingSide final : public Stage {
 public:
  WritingSide(const sc_core::sc_module_name& name, const ClockDomain& clock, Dataflow& dataflow,
              std::uint32_t latency)
      : Stage(name, clock, dataflow, latency) {}

 private:
  void end_of_elaboration() override {}
};

void Stage::set_schedule(StageSchedule schedule) {
  schedule_ = std::move(schedule.reading);
  if (schedule.writing.empty()) return;
  writing_side_ = std::make_unique<WritingSide>(fmt::format("{}_writing", basename()).c_str(), clock_,
                                                dataflow_, latency_);
  writing_side_->schedule_ = std::move(schedule.writing);
  latency_ = 0;
  const auto join = [this](const char* what, std::uint32_t depth, std::uint32_t write_to_read) {
    FifoConfig config;
    config.depth = depth;
    config.width = Bits(0);
    config.write_to_read = write_to_read;
    config.read_to_write = 0;
    config.inside_stage = true;
    const std::string name = fmt::format("{}_{}", basename(), what);
    return std::make_unique<Stream<std::uint8_t>>(name.c_str(), dataflow_, clock_, clock_, config);
  };
  handed_ = join("handed", 1, 0);
  kept_ = join("kept", schedule.kept, 1);
}

// Each side gets the ports that its schedule names, and the two streams between them.
void Stage::share_ports(StreamsOfPorts in, StreamsOfPorts out) {
  in.resize(kMaxPorts);
  out.resize(kMaxPorts);
  const auto at = [](unsigned port, const StreamsOfPorts& ports, PortMask mask) {
    return ((mask >> port) & 1u) != 0 ? ports[port] : std::vector<StreamBase*>{};
  };
  for (Stage* side : {this, writing_side_.get()}) {
    const bool reads = side == this;
    StreamsOfPorts own_in;
    StreamsOfPorts own_out;
    for (unsigned port = 0; port < kMaxPorts; ++port) {
      own_in.push_back(at(port, in, ports_of(side->schedule_, &Phase::consume)));
      own_out.push_back(at(port, out, ports_of(side->schedule_, &Phase::produce)));
    }
    StreamsOfPorts& joint = reads ? own_out : own_in;
    joint[StageSchedule::kHandedPort] = {handed_.get()};
    joint[StageSchedule::kKeptPort] = {kept_.get()};
    for (const auto& streams : own_in) {
      for (StreamBase* stream : streams) stream->attach_reader(side->name(), side);
    }
    for (const auto& streams : own_out) {
      for (StreamBase* stream : streams) stream->attach_writer(side->name(), side);
    }
    side->bind_ports(own_in, own_out);
  }
}

}  // namespace parallax
