// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tlm/fifo_kind.hpp"

namespace parallax {

class Schema;
struct FifoConfig;

/// Names of the streams of the pipeline, as they appear in reports, upstream to downstream.
const std::vector<std::string>& pipeline_stream_names();

/// FIFO depth of one stream.
struct StreamDepth {
  std::string name;
  std::uint32_t tokens = 0;  ///< 0 to 16777216; 0 = automatic; own choice
};

/// Kind of FIFO of one stream.
struct StreamKind {
  static constexpr std::int32_t kOfTheKind = -1;
  static constexpr std::int32_t kMostEdges = 64;

  std::string name;
  std::optional<FifoKind> kind{};  ///< none = the default kind; own choice
  /// Edges, as in FifoConfig. For kind kFree 0 to kMostEdges, 0 where both sides have one clock; for
  /// kAsynchronous 2 to kMostEdges, one more than there are synchroniser registers on the way. kOfTheKind:
  /// not given, which is 1 for kFree; own choice.
  std::int32_t write_to_read = kOfTheKind;
  std::int32_t read_to_write = kOfTheKind;
  std::uint32_t not_ready_cycles = 0;  ///< FifoConfig::not_ready_cycles, 0 to 65536; own choice
};

/// FIFOs of the streams: depths in tokens, and kinds.
struct StreamConfig {
  std::uint32_t default_depth = 16;  ///< of a stream whose own depth is 0; 1 to 65536; own choice
  std::vector<StreamDepth> depths;   ///< one per stream, upstream to downstream

  FifoKind default_kind = FifoKind::kRegistered;  ///< of a stream without a kind of its own; own choice
  std::vector<StreamKind> kinds;                  ///< one per stream, upstream to downstream
  std::uint32_t synchroniser_stages = 2;  ///< of every asynchronous FIFO, each way; 1 to 8; own choice

  explicit StreamConfig(const std::vector<std::string>& names = pipeline_stream_names());
  /// One more stream, behind the others.
  void add(const std::string& name);

  /// The depth to build `name` with. `needed` is the least depth at which it cannot stall the paths that fork
  /// and meet again around it; an automatic depth is at least that.
  std::uint32_t resolve(const std::string& name, std::uint32_t needed) const;
  /// The kind of FIFO to build `name` with.
  FifoKind kind(const std::string& name) const;
  /// The delays of that FIFO, in edges.
  FifoOffsets offsets(const std::string& name) const;
  /// Writes kind, delays and cycles after reset of that FIFO into `fifo`.
  void set_kind(const std::string& name, FifoConfig& fifo) const;

  /// Throws UserError, naming the key, when offsets are given to a kind that has its own, or are none of an
  /// asynchronous FIFO.
  void validate() const;

 private:
  const StreamKind& stream(const std::string& name) const;
};

/// Declares `streams.default_depth`, `streams.default_kind`, `streams.synchroniser_stages`, and
/// `streams.<name>.depth`, `.kind`, `.write_to_read`, `.read_to_write` and `.not_ready_cycles` for every name
/// in the configuration.
void describe(Schema& schema, StreamConfig& config);

}  // namespace parallax
