// SPDX-License-Identifier: Apache-2.0
// Whole machines with small images and random clocks, rates, depths and buffers.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "tests/timing/in_child.hpp"
#include "tests/timing/machine_bench.hpp"

namespace parallax::test {

struct MachineCase {
  int width = 0;
  int height = 0;
  std::int64_t frames = 0;
  std::map<std::string, std::int64_t> speeds;  ///< keys of which more is faster
  std::vector<std::string> others;             ///< all other assignments

  std::vector<std::string> assignments() const {
    std::vector<std::string> all = others;
    for (const auto& [key, value] : speeds) all.push_back(fmt::format("{}={}", key, value));
    return all;
  }
  std::string text() const {
    return fmt::format("{} x {}, {} frames, {}\n", width, height, frames, fmt::join(assignments(), " "));
  }
};

/// How much the ports of the memory get in one another's way.
enum class Contention { kAny, kNone };

/// Drawn from a seed, so that there is nothing to shrink.
inline MachineCase random_machine(std::uint32_t seed, Contention contention) {
  std::mt19937 random(seed);
  const auto number = [&random](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  const auto hertz = [&number](int low, int high) {
    return number(low, high) * 1'000'003ll;
  };  // no round ratios
  MachineCase c;
  c.width = number(8, 64);
  c.height = number(4, 48);
  c.frames = number(1, 12);
  c.speeds = {{"clocks.core_hz", hertz(50, 250)},
              {"clocks.camera_hz", hertz(20, 250)},
              {"clocks.link_hz", hertz(50, 200)},
              {"camera.bytes_per_second", number(20, 500) * 1'000'000ll},
              {"link.line_rate", number(100, 2000) * 1'000'000ll},
              {"link.host_pixel_rate", number(1, 60) * 1'000'000ll}};
  c.others = {"rectification.window=9", "software.response_ns=0"};
  const auto set = [&c](const std::string& key, int value) {
    c.others.push_back(fmt::format("{}={}", key, value));
  };
  set("matching.iterations", number(1, 4));
  set("streams.default_depth", number(2, 32));
  set("camera.row_blanking", number(0, 20));
  set("camera.frame_buffers", number(1, 4));
  set("link.output_buffers", number(1, 3));
  set("dma.left.outstanding", number(1, 4));
  set("dma.camera.burst_bytes", 8 << number(0, 4));
  if (contention == Contention::kNone) {
    // All ports at once are served within any cycle of the others' clocks.
    for (const char* fast :
         {"memory.model=bus", "clocks.memory_hz=10000000000", "memory.bytes_per_cycle=1024",
          "memory.efficiency=100", "memory.latency_cycles=0", "memory.latency_ns=0"}) {
      c.others.emplace_back(fast);
    }
  } else {
    c.others.emplace_back("memory.model=bus");
    c.speeds["clocks.memory_hz"] = hertz(20, 600);
    c.speeds["memory.bytes_per_cycle"] = 1 << number(0, 4);
    set("memory.queue_depth", number(1, 4));
    c.others.push_back(number(0, 2) == 0 ? "memory.arbitration=fixed_priority"
                                         : "memory.arbitration=round_robin");
  }
  if (number(0, 1) == 0) c.others.emplace_back("software.queue_frames=true");
  if (number(0, 2) == 0) {
    c.width += c.width % 2;
    const int left = 2 * number(0, 3);
    const int right = 2 * number(0, 3);
    c.others.emplace_back("tiles.disparities_in_margin=false");
    set("tiles.left_margin", left);
    set("tiles.right_margin", right);
    set("tiles.limit", (std::max({8, (c.width + left + right + 1) / 2, left + right + 2}) + 1) / 2 * 2);
  }
  const char* formats[] = {"mono8", "mono8", "mono12", "rgb8", "bayer8"};
  c.others.push_back(std::string("camera.format=") + formats[number(0, 4)]);
  if (number(0, 3) == 0) c.others.emplace_back("link.color_output=true");
  if (number(0, 3) == 0) c.others.emplace_back("matching.path_storage=memory");
  if (number(0, 3) == 0) c.others.emplace_back("matching.paths=w,n,ne,s");
  set("dma.buffer.outstanding", number(1, 8));
  if (number(0, 2) == 0) set("link.early_start_rows", number(1, 60));
  if (number(0, 2) == 0) {
    set("camera.early_start_rows", number(1, 60));
  } else if (number(0, 2) == 0) {
    const char* faults[] = {"short_frame", "missing_row", "out_of_step"};
    c.others.push_back(std::string("camera.fault=") + faults[number(0, 2)]);
    set("camera.fault_every", number(2, 5));
    set("camera.skew_limit_ns", number(1, 50) * 1000);
  }
  if (number(0, 3) == 0) set("camera.skew_ns", number(1, 1000));
  if (number(0, 3) == 0) set("camera.exposure_ns", number(1, 100000));
  if (number(0, 3) == 0) c.others.emplace_back("camera.overlap=false");
  return c;
}

/// What `look` says of the machine after its run, timing only; why it did not end, if it did not.
inline std::string after_run(const MachineCase& c, const std::function<std::string(const Machine&)>& look) {
  return in_child([&] {
    const MachineConfig config = preset(c.assignments());
    const EncodedMap map = encode(lens_map(c.width, c.height, config.rectification.range));
    MachineInput input;
    input.width = c.width;
    input.height = c.height;
    input.map = &map;
    input.frames = c.frames;
    input.expose = [](std::int64_t) { return StereoFrame{}; };
    const Machine machine("machine", config, input);
    sc_core::sc_start();
    if (!machine.finished()) return "stuck:\n" + describe(machine.dataflow().waits());
    return look(machine);
  });
}

}  // namespace parallax::test
