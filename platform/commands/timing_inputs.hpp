// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <tuple>

#include "platform/evaluation/timing_evaluator.hpp"
#include "platform/input/frame_source.hpp"
#include "platform/input/run_options.hpp"

namespace parallax {

/// The input of `parallax run` as several machines see it. Images are opened anew only when a key about their
/// size changes, the map is built once for every window, precision and processed size.
class TimingInputs {
 public:
  TimingInputs(const RunOptions& options, NoticeSink notice);

  /// Throws UserError when the images cannot be read, or the configuration and the input do not go together.
  void open(const MachineConfig& config) { source_for(config); }
  /// Likewise. The result points into this object.
  TimingInput prepare(const MachineConfig& config);

 private:
  using SourceKey = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, int, int>;
  using MapKey = std::tuple<int, int, int, int, int, int>;

  const FrameSource& source_for(const MachineConfig& config);
  const EncodedMap& map_for(const MachineConfig& config, const FrameSource& source);

  const RunOptions& options_;
  const NoticeSink notice_;
  std::unique_ptr<FrameSource> source_;
  SourceKey source_key_;
  std::map<MapKey, EncodedMap> maps_;
};

}  // namespace parallax
