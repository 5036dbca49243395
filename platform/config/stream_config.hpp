// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace parallax {

class Schema;

/// Names of the streams of the pipeline, as they appear in reports, upstream to downstream.
const std::vector<std::string>& pipeline_stream_names();

/// FIFO depth of one stream.
struct StreamDepth {
  std::string name;
  std::uint32_t tokens = 0;  ///< 0 to 16777216; 0 = automatic; own choice
};

/// FIFO depths of the streams, in tokens.
struct StreamConfig {
  std::uint32_t default_depth = 16;  ///< of a stream whose own depth is 0; 1 to 65536; own choice
  std::vector<StreamDepth> depths;   ///< one per stream, upstream to downstream

  explicit StreamConfig(const std::vector<std::string>& names = pipeline_stream_names());

  /// The depth to build `name` with. `needed` is the least depth at which it cannot stall the paths that fork
  /// and meet again around it; an automatic depth is at least that.
  std::uint32_t resolve(const std::string& name, std::uint32_t needed) const;
};

/// Declares `streams.default_depth` and `streams.<name>.depth` for every name in the configuration.
void describe(Schema& schema, StreamConfig& config);

}  // namespace parallax
