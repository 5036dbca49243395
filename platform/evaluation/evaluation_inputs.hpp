// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <tuple>

#include "platform/evaluation/evaluate.hpp"
#include "platform/input/frame_source.hpp"
#include "platform/input/run_options.hpp"

namespace parallax {

/// The input of `parallax run` as several machines see it. Images are opened anew only when a key about their
/// size changes, the map is built once for every window, precision and processed size.
class EvaluationInputs {
 public:
  /// `options` must outlive this object.
  explicit EvaluationInputs(const RunOptions& options) : options_(options) {}

  /// Throws UserError when the images cannot be read, or the configuration and the input do not go together.
  void open(const MachineConfig& config, const NoticeSink& notice) { source_for(config, notice); }
  /// Likewise. The result points into this object.
  EvaluationInput prepare(const MachineConfig& config, const NoticeSink& notice);

 private:
  using SourceKey = std::tuple<std::uint32_t, std::uint32_t, int, int, int, int>;
  using MapKey = std::tuple<int, int, int, int, int, int>;

  const FrameSource& source_for(const MachineConfig& config, const NoticeSink& notice);
  const EncodedMap& map_for(const MachineConfig& config, const FrameSource& source, const NoticeSink& notice);

  const RunOptions& options_;
  std::unique_ptr<FrameSource> source_;
  SourceKey source_key_;
  std::map<MapKey, EncodedMap> maps_;
};

}  // namespace parallax
