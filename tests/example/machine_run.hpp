// SPDX-License-Identifier: Apache-2.0
// A small machine that only its pipeline limits, with images: what comes out, and when.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "tests/timing/in_child.hpp"
#include "tests/timing/machine_bench.hpp"

namespace parallax::test {

constexpr int kWidth = 96;
constexpr int kHeight = 48;
constexpr std::int64_t kFrames = 4;

/// What a run gave: a fault's text, or the disparities of the last frame and dates in cycles of the core.
struct MachineRun {
  std::string fault;
  std::vector<Disparity> disparities;
  std::int64_t period = 0;                         ///< from the last but one frame to the last one
  std::int64_t first = 0;                          ///< from the first frame's start to its first disparity
  std::int64_t left_texture = 0, left_output = 0;  ///< depths
  std::uint64_t census_dates = 0;                  ///< CensusDates::hash()
};

/// Of the streams before and behind the census stage, the dates of its side, of all pixels of these frames.
class CensusDates {
 public:
  explicit CensusDates(const Dataflow& dataflow) {
    for (StreamBase* stream : dataflow.streams()) {
      const std::string name = stream->basename();
      const bool reads = name == "left_rectified" || name == "right_rectified";
      if (reads || name == "left_codes" || name == "right_codes")
        stream->add_listener(sides_.emplace_back(reads));
    }
  }
  /// 0 while some are not there yet.
  std::uint64_t hash() const {
    std::uint64_t hash = 0;
    for (const Side& side : sides_) {
      if (side.left > 0) return 0;
      hash = hash * 31 + side.hash;
    }
    return hash;
  }

 private:
  struct Side final : StreamListener {
    explicit Side(bool of_reads) : reads(of_reads) {}
    void written(const StreamBase&, Cycles cycle) override { note(!reads, cycle); }
    void read(const StreamBase&, Cycles cycle) override { note(reads, cycle); }
    void note(bool wanted, Cycles cycle) {
      if (!wanted || left == 0) return;
      --left;
      hash = (hash ^ cycle.size()) * 1099511628211u;
    }
    const bool reads;
    std::uint64_t left = std::uint64_t{kWidth} * kHeight * kFrames;
    std::uint64_t hash = 14695981039346656037u;
  };
  std::deque<Side> sides_;
};

inline MachineConfig small_machine(const std::vector<std::string>& assignments = {}) {
  std::vector<std::string> all{"rectification.window=9"};
  all.insert(all.end(), assignments.begin(), assignments.end());
  return pipeline_alone(preset(all));
}

/// `spare`: frames with images beyond those that are looked at. The cameras go on without images, and a block
/// in kernel time that reads values would miss them.
inline MachineRun run_machine(const MachineConfig& config, const StageReplacements& replacements = {},
                              std::int64_t spare = 4) {
  const std::string text = in_child([&] {
    const EncodedMap map = encode(lens_map(kWidth, kHeight, config.rectification.range));
    MachineInput input;
    input.width = kWidth;
    input.height = kHeight;
    input.map = &map;
    input.frames = kFrames + spare;
    input.replacements = replacements;
    input.expose = [](std::int64_t) {
      return StereoFrame{shifted_bars(kWidth, kHeight, 12), shifted_bars(kWidth, kHeight, 20)};
    };
    std::vector<Disparity> last;
    input.deliver = [&last](const FrameResult& result) {
      if (result.index + 1 != kFrames) return;
      last = result.disparities;
      sc_core::sc_stop();
    };
    const Machine machine("machine", config, input);
    const CensusDates census_dates(machine.dataflow());
    sc_core::sc_start();
    if (last.empty()) return "stuck:\n" + describe(machine.dataflow().waits());
    const auto cycles = [&](sc_core::sc_time begin, sc_core::sc_time end) {
      return std::llround((end - begin).to_seconds() * static_cast<double>(config.clocks.core_hz));
    };
    std::ostringstream out;
    const auto& times = machine.times();
    out << cycles(times[kFrames - 2].results_in_memory, times[kFrames - 1].results_in_memory) << " "
        << cycles(times[0].core_started, times[0].first_disparity);
    for (const char* name : {"left_texture", "left_output"}) {
      for (const StreamBase* stream : machine.dataflow().streams()) {
        if (stream->basename() == std::string(name)) out << " " << stream->depth();
      }
    }
    out << " " << census_dates.hash();
    for (const Disparity& d : last) out << " " << d.value << " " << static_cast<int>(d.cause);
    return out.str();
  });
  MachineRun run;
  std::istringstream in(text);
  if (!(in >> run.period >> run.first >> run.left_texture >> run.left_output >> run.census_dates)) {
    run.fault = text;
    return run;
  }
  for (int value, cause; in >> value >> cause;) {
    run.disparities.push_back({static_cast<std::uint16_t>(value), static_cast<Cause>(cause)});
  }
  return run;
}

/// What a filter's kernel makes of an image.
template <class Kernel, class Config>
std::vector<Disparity> filtered(const Config& config, const std::vector<Disparity>& image) {
  Kernel kernel(config, kWidth, kHeight);
  std::vector<Disparity> out;
  for (int y = 0; y < kHeight; ++y) {
    kernel.push(image.data() + y * kWidth,
                [&](const Disparity* row) { out.insert(out.end(), row, row + kWidth); });
  }
  return out;
}

}  // namespace parallax::test
