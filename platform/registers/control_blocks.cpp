// SPDX-License-Identifier: Apache-2.0
#include "platform/registers/control_blocks.hpp"

#include <algorithm>
#include <utility>

#include "platform/registers/register_map.hpp"
#include "tlm/time_resolution.hpp"

namespace parallax {
namespace {

const char* bit_of(CameraFault fault) {
  return fault == CameraFault::kShortFrame   ? "short_frame"
         : fault == CameraFault::kMissingRow ? "missing_row"
                                             : "out_of_step";
}

std::uint64_t value(const RegisterBank::Field& high, const RegisterBank::Field& low) {
  return std::uint64_t{high.get()} << 32 | low.get();
}

}  // namespace

ControlBlocks::ControlBlocks(const sc_core::sc_module_name& name, const MachineConfig& config,
                             const CoreFacts& facts, Hooks hooks)
    : sc_module(name),
      bank("bank", register_blocks(), nanoseconds(config.software.register_ns)),
      config_(config),
      facts_(facts),
      hooks_(std::move(hooks)),
      busy_(dma("status", "busy")),
      ready_(dma("status", "ready")),
      frames_done_field_(dma("status", "frames_done")),
      output_bytes_(dma("output_bytes_available", "bytes")),
      faulty_frames_field_(dma("input_errors", "frames")),
      enable_(stereo("control", "enable")),
      widths_{dma("image_size", "width"), stereo("image_size", "width")},
      heights_{dma("image_size", "height"), stereo("image_size", "height")},
      bytes_available_{dma("left_bytes_available", "bytes"), dma("right_bytes_available", "bytes")},
      left_(address_of("left")),
      right_(address_of("right")),
      map_(address_of("map")),
      output_(address_of("output")),
      buffer_(address_of("buffer")),
      parameters_(algorithm_parameters(config)) {
  for (const RunTimeParameter& p : run_time_parameters()) {
    parameter_fields_.push_back({&p, stereo(p.reg, p.field)});
  }
  bank.on_write("dma", "control", [this](std::uint32_t triggers) { start(triggers); });
  show_fifo_on_read("input_fifo_info", {facts_.left, facts_.right});
  show_fifo_on_read("map_fifo_info", {facts_.map});
  show_fifo_on_read("buffer_fifo_info", facts_.buffer);
  show_fifo_on_read("output_fifo_info", {facts_.output});
  bank.on_read("dma", "output_bytes_available", [this] {
    const std::uint64_t bytes = facts_.output.master->statistics().bytes - output_before_;
    output_bytes_.set(static_cast<std::uint32_t>(std::min(bytes, facts_.output_bytes)));
  });
}

ControlBlocks::Address ControlBlocks::address_of(const std::string& data) {
  return {dma(data + "_address_high", "address"), dma(data + "_address_low", "address")};
}

void ControlBlocks::show_fifo_on_read(const std::string& reg, const std::vector<CoreFacts::Master>& ports) {
  std::uint32_t slots = 0;
  for (const CoreFacts::Master& port : ports) slots += port.slots;
  bank.on_read("dma", reg,
               [ports, slots, under_way_field = dma(reg, "under_way"), places_field = dma(reg, "places")] {
                 std::uint64_t under_way = 0;
                 for (const CoreFacts::Master& port : ports) under_way += port.master->in_flight();
                 under_way_field.set(static_cast<std::uint32_t>(under_way));
                 places_field.set(slots);
               });
}

void ControlBlocks::start(std::uint32_t triggers) {
  if (triggers == 0 || !judge_start()) return;
  if (AlgorithmParameters parameters = demanded(); judge(parameters)) parameters_ = std::move(parameters);
  if (under_way_++ == 0) output_before_ = facts_.output.master->statistics().bytes;
  busy_.set(1);
  ready_.set(config_.software.queue_frames ? 1 : 0);
  hooks_.on_start({value(left_.high, left_.low), value(right_.high, right_.low), value(map_.high, map_.low),
                   value(output_.high, output_.low), value(buffer_.high, buffer_.low), parameters_});
}

bool ControlBlocks::judge_start() {
  bool good = true;
  const auto require = [&](bool holds, const char* bit) {
    if (holds) return;
    bank.set("dma", "errors", bit, 1);
    good = false;
  };
  const auto all = [](const std::vector<Field>& fields, const auto& holds) {
    return std::all_of(fields.begin(), fields.end(), [&](const Field& f) { return holds(f.get()); });
  };
  const auto is = [](int size) {
    return [bits = size & 0xFFFFU](std::uint32_t have) { return have == bits; };
  };
  require(ready_.get() != 0 && hooks_.expected(), "not_ready");
  require(enable_.get() != 0, "disabled");
  require(all(widths_, is(facts_.width)) && all(heights_, is(facts_.height)), "size");
  require(all(bytes_available_, [this](std::uint32_t bytes) { return bytes >= facts_.start_bytes; }),
          "bytes");
  require(in_memory(left_, facts_.image_bytes) && in_memory(right_, facts_.image_bytes) &&
              in_memory(map_, facts_.map_bytes) && in_memory(output_, facts_.output_bytes) &&
              (facts_.buffer_bytes == 0 || in_memory(buffer_, facts_.buffer_bytes)),
          "address");
  return good;
}

bool ControlBlocks::in_memory(const Address& address, std::uint64_t bytes) const {
  const std::uint64_t begin = value(address.high, address.low);
  return begin <= facts_.memory_bytes && bytes <= facts_.memory_bytes - begin;
}

AlgorithmParameters ControlBlocks::demanded() const {
  AlgorithmParameters parameters;
  for (const ParameterField& p : parameter_fields_) {
    parameters.values.push_back(p.parameter->decode(p.field.get()));
  }
  return parameters;
}

bool ControlBlocks::judge(const AlgorithmParameters& parameters) {
  const MachineConfig asked = with_parameters(config_, parameters);
  bool good = true;
  for (const RunTimeParameter& p : run_time_parameters()) {
    if (p.rule == nullptr || p.rule->holds(p, asked, config_)) continue;
    bank.set("stereo", "errors", p.rule->error, 1);
    good = false;
  }
  return good;
}

void ControlBlocks::frame_done() {
  --under_way_;
  ++frames_done_;
  output_before_ = facts_.output.master->statistics().bytes;
  frames_done_field_.set(frames_done_);
  busy_.set(under_way_ > 0 ? 1 : 0);
  ready_.set(1);
}

void ControlBlocks::frame_faulty(CameraFault fault) {
  bank.set("dma", "input_errors", bit_of(fault), 1);
  faulty_frames_field_.set(++frames_faulty_);
}

}  // namespace parallax
