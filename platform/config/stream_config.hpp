// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tlm/fifo_kind.hpp"

namespace parallax {

class Schema;

/// Names of the streams of the pipeline, as they appear in reports, upstream to downstream.
const std::vector<std::string>& pipeline_stream_names();

/// FIFO depth of one stream.
struct StreamDepth {
  std::string name;
  std::uint32_t tokens = 0;  ///< 0 to 16777216; 0 = automatic; own choice
};

/// Kind of FIFO of one stream.
struct StreamKind {
  std::string name;
  std::optional<FifoKind> kind;  ///< not kFree; none = the default kind; own choice
};

/// FIFOs of the streams: depths in tokens, and kinds.
struct StreamConfig {
  std::uint32_t default_depth = 16;  ///< of a stream whose own depth is 0; 1 to 65536; own choice
  std::vector<StreamDepth> depths;   ///< one per stream, upstream to downstream

  FifoKind default_kind =
      FifoKind::kRegistered;              ///< of a stream without a kind of its own; not kFree; own choice
  std::vector<StreamKind> kinds;          ///< one per stream, upstream to downstream
  std::uint32_t synchroniser_stages = 2;  ///< of every asynchronous FIFO; 1 to 8; own choice

  explicit StreamConfig(const std::vector<std::string>& names = pipeline_stream_names());
  /// One more stream, behind the others.
  void add(const std::string& name);

  /// The depth to build `name` with. `needed` is the least depth at which it cannot stall the paths that fork
  /// and meet again around it; an automatic depth is at least that.
  std::uint32_t resolve(const std::string& name, std::uint32_t needed) const;
  /// The kind of FIFO to build `name` with.
  FifoKind kind(const std::string& name) const;
  /// The delays of that FIFO, in cycles.
  FifoOffsets offsets(const std::string& name) const { return offsets_of(kind(name), synchroniser_stages); }
};

/// Declares `streams.default_depth`, `streams.default_kind`, `streams.synchroniser_stages`, and
/// `streams.<name>.depth` and `streams.<name>.kind` for every name in the configuration.
void describe(Schema& schema, StreamConfig& config);

}  // namespace parallax
