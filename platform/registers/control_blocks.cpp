// SPDX-License-Identifier: Apache-2.0
#include "platform/registers/control_blocks.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "platform/registers/register_map.hpp"

namespace parallax {
namespace {

constexpr int kUnit = 256;        // of the uniqueness factor
constexpr int kMaxFactor = 4096;  // 16

}  // namespace

ControlBlocks::ControlBlocks(const sc_core::sc_module_name& name, const MachineConfig& config,
                             const CoreFacts& facts, Hooks hooks)
    : sc_module(name),
      bank("bank", register_blocks(),
           sc_core::sc_time(static_cast<double>(config.software.register_ns), sc_core::SC_NS)),
      config_(config),
      facts_(facts),
      hooks_(std::move(hooks)),
      parameters_(algorithm_parameters(config)) {
  bank.on_write("dma", "control", [this](std::uint32_t triggers) { start(triggers); });
  bank.on_read("dma", "input_fifo_info", [this] {
    show_fifo("input_fifo_info", {facts_.left, facts_.right});
  });
  bank.on_read("dma", "map_fifo_info", [this] { show_fifo("map_fifo_info", {facts_.map}); });
  bank.on_read("dma", "buffer_fifo_info", [this] { show_fifo("buffer_fifo_info", facts_.buffer); });
  bank.on_read("dma", "output_fifo_info", [this] { show_fifo("output_fifo_info", {facts_.output}); });
  bank.on_read("dma", "output_bytes_available", [this] {
    const std::uint64_t bytes = facts_.output.master->statistics().bytes - output_before_;
    bank.set("dma", "output_bytes_available", "bytes",
             static_cast<std::uint32_t>(std::min(bytes, facts_.output_bytes)));
  });
}

void ControlBlocks::show_fifo(const char* reg, const std::vector<CoreFacts::Port>& ports) {
  std::uint32_t under_way = 0;
  std::uint32_t places = 0;
  for (const CoreFacts::Port& port : ports) {
    under_way += static_cast<std::uint32_t>(port.master->in_flight());
    places += port.places;
  }
  bank.set("dma", reg, "under_way", under_way);
  bank.set("dma", reg, "places", places);
}

void ControlBlocks::error(const char* block, const char* bit) { bank.set(block, "errors", bit, 1); }

std::uint64_t ControlBlocks::address(const std::string& name) const {
  return std::uint64_t{bank.get("dma", name + "_address_high", "address")} << 32 |
         bank.get("dma", name + "_address_low", "address");
}

void ControlBlocks::start(std::uint32_t triggers) {
  if (triggers == 0 || !judge_start()) return;
  if (judge_parameters()) {
    AlgorithmParameters& p = parameters_;
    const auto number = [this](const char* reg, const char* field) {
      return static_cast<int>(stereo(reg, field));
    };
    const auto on = [this](const char* field) { return stereo("algorithm_parameters_2", field) != 0; };
    p.p1 = number("algorithm_parameters_1", "p1");
    p.p2 = number("algorithm_parameters_1", "p2");
    p.uniqueness_factor = kUnit + number("algorithm_parameters_1", "uniqueness");
    p.texture_threshold = number("algorithm_parameters_2", "texture");
    p.consistency_threshold = number("algorithm_parameters_2", "consistency");
    p.speckle_iterations = number("algorithm_parameters_2", "speckle_iterations");
    p.mask_border = on("mask_border");
    p.uniqueness = on("uniqueness_enable");
    p.consistency = on("consistency_enable");
    p.texture = on("texture_enable");
    p.gap_interpolation = on("gap_enable");
    p.noise_reduction = on("noise_enable");
  }
  if (under_way_++ == 0) output_before_ = facts_.output.master->statistics().bytes;
  bank.set("dma", "status", "busy", 1);
  bank.set("dma", "status", "ready", config_.software.queue_frames ? 1 : 0);
  hooks_.on_start(
      {address("left"), address("right"), address("map"), address("output"), address("buffer"), parameters_});
}

bool ControlBlocks::judge_start() {
  bool good = true;
  const auto require = [&](bool holds, const char* bit) {
    if (holds) return;
    error("dma", bit);
    good = false;
  };
  require(bank.get("dma", "status", "ready") != 0 && hooks_.expected(), "not_ready");
  require(stereo("control", "enable") != 0, "disabled");
  for (const char* block : {"dma", "stereo"}) {
    require(
        bank.get(block, "image_size", "width") == (static_cast<std::uint32_t>(facts_.width) & 0xFFFFU) &&
            bank.get(block, "image_size", "height") == (static_cast<std::uint32_t>(facts_.height) & 0xFFFFU),
        "size");
  }
  for (const char* image : {"left", "right"}) {
    require(bank.get("dma", std::string(image) + "_bytes_available", "bytes") >= facts_.start_bytes, "bytes");
  }
  const auto in_memory = [this](const char* name, std::uint64_t bytes) {
    const std::uint64_t begin = address(name);
    return begin <= facts_.memory_bytes && bytes <= facts_.memory_bytes - begin;
  };
  require(in_memory("left", facts_.image_bytes) && in_memory("right", facts_.image_bytes) &&
              in_memory("map", facts_.map_bytes) && in_memory("output", facts_.output_bytes) &&
              (facts_.buffer_bytes == 0 || in_memory("buffer", facts_.buffer_bytes)),
          "address");
  return good;
}

bool ControlBlocks::judge_parameters() {
  bool good = true;
  const auto require = [&](bool holds, const char* bit) {
    if (holds) return;
    error("stereo", bit);
    good = false;
  };
  const char* one = "algorithm_parameters_1";
  const char* two = "algorithm_parameters_2";
  require(stereo(one, "p1") < stereo(one, "p2"), "penalties");
  require(stereo(one, "uniqueness") <= kMaxFactor - kUnit, "uniqueness");
  require(stereo("control", "iterations") + 1 == static_cast<std::uint32_t>(config_.matching.iterations) &&
              stereo(two, "offset") == static_cast<std::uint32_t>(config_.matching.disparity_offset),
          "range");
  require(stereo(two, "speckle_iterations") <= static_cast<std::uint32_t>(config_.speckle.iterations),
          "speckle");
  const auto built = [&](const char* field, bool there) {
    require(stereo(two, field) == 0 || there, "switches");
  };
  built("uniqueness_enable", config_.uniqueness.enabled);
  built("consistency_enable", config_.consistency.enabled);
  built("texture_enable", config_.texture.enabled);
  built("gap_enable", config_.gap_interpolation.enabled);
  built("noise_enable", config_.noise_reduction.enabled);
  return good;
}

void ControlBlocks::frame_done() {
  --under_way_;
  ++frames_done_;
  output_before_ = facts_.output.master->statistics().bytes;
  bank.set("dma", "status", "frames_done", frames_done_ & 0xFFFFU);
  bank.set("dma", "status", "busy", under_way_ > 0 ? 1 : 0);
  bank.set("dma", "status", "ready", 1);
}

void ControlBlocks::frame_faulty(CameraFault fault) {
  const char* bit = fault == CameraFault::kShortFrame   ? "short_frame"
                    : fault == CameraFault::kMissingRow ? "missing_row"
                                                        : "out_of_step";
  bank.set("dma", "input_errors", bit, 1);
  bank.set("dma", "input_errors", "frames", ++frames_faulty_ & 0xFFFFU);
}

}  // namespace parallax
