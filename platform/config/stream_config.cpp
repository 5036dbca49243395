// SPDX-License-Identifier: Apache-2.0
#include "platform/config/stream_config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "platform/config/disparity_filters.hpp"
#include "platform/config/schema.hpp"
#include "tlm/error.hpp"
#include "tlm/stream_base.hpp"

namespace parallax {
namespace {

constexpr std::int32_t kLeastAsynchronous = 2;  // edges

}  // namespace

const std::vector<std::string>& pipeline_stream_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{"left_pixels",       "right_pixels",    "map_words",      "map_entries",
                                 "left_rectified",    "right_rectified", "left_texture",   "left_output",
                                 "left_codes",        "right_codes",     "costs_subpixel", "costs_uniqueness",
                                 "costs_consistency", "winners",         "unique",         "consistent",
                                 "textured"};
    const std::vector<std::string> filtered = disparity_filters().streams();
    all.insert(all.end(), filtered.begin(), filtered.end());
    all.insert(all.end(), {"kept_rows", "returned_rows", "kept_frame", "returned_frame"});
    return all;
  }();
  return names;
}

StreamConfig::StreamConfig(const std::vector<std::string>& names) {
  for (const std::string& name : names) add(name);
}

void StreamConfig::add(const std::string& name) {
  depths.push_back({name, 0});
  kinds.push_back({name});
}

std::uint32_t StreamConfig::resolve(const std::string& name, std::uint32_t needed) const {
  const auto stream = std::find_if(depths.begin(), depths.end(),
                                   [&](const StreamDepth& depth) { return depth.name == name; });
  if (stream == depths.end()) throw std::logic_error("no stream is called " + name);
  return stream->tokens != 0 ? stream->tokens : std::max(default_depth, needed);
}

const StreamKind& StreamConfig::stream(const std::string& name) const {
  const auto found =
      std::find_if(kinds.begin(), kinds.end(), [&](const StreamKind& kind) { return kind.name == name; });
  if (found == kinds.end()) throw std::logic_error("no stream is called " + name);
  return *found;
}

FifoKind StreamConfig::kind(const std::string& name) const {
  return stream(name).kind.value_or(default_kind);
}

FifoOffsets StreamConfig::offsets(const std::string& name) const {
  const FifoKind of = kind(name);
  const std::uint32_t stages = synchroniser_stages;
  const FifoOffsets usual = of == FifoKind::kFree ? FifoOffsets{1, 1} : offsets_of(of, {stages, stages});
  const auto edges = [](std::int32_t given, std::uint32_t otherwise) {
    return given == StreamKind::kOfTheKind ? otherwise : static_cast<std::uint32_t>(given);
  };
  return {edges(stream(name).write_to_read, usual.write_to_read),
          edges(stream(name).read_to_write, usual.read_to_write)};
}

void StreamConfig::set_kind(const std::string& name, FifoConfig& fifo) const {
  fifo.kind = kind(name);
  fifo.not_ready_cycles = stream(name).not_ready_cycles;
  const FifoOffsets delays = offsets(name);
  if (fifo.kind == FifoKind::kAsynchronous) {
    fifo.synchroniser_stages = {delays.write_to_read - 1, delays.read_to_write - 1};
  } else if (fifo.kind == FifoKind::kFree) {
    fifo.write_to_read = delays.write_to_read;
    fifo.read_to_write = delays.read_to_write;
  }
}

void StreamConfig::validate() const {
  for (const StreamKind& stream : kinds) {
    const FifoKind kind = stream.kind.value_or(default_kind);
    if (kind == FifoKind::kFree) continue;
    const auto check = [&](const char* key, std::int32_t given) {
      if (given == StreamKind::kOfTheKind) return;
      if (kind != FifoKind::kAsynchronous) {
        throw UserError(
            fmt::format("streams.{0}.{1} = {2}: a FIFO of kind {3} has delays of its own; streams.{0}.kind = "
                        "free takes them",
                        stream.name, key, given, name_of(kind)));
      }
      if (given < kLeastAsynchronous) {
        throw UserError(
            fmt::format("streams.{0}.{1} = {2}: an asynchronous FIFO has at least {3}, the edge that "
                        "captures the pointer "
                        "and a synchroniser register; streams.{0}.kind = free takes less",
                        stream.name, key, given, kLeastAsynchronous));
      }
    };
    check("write_to_read", stream.write_to_read);
    check("read_to_write", stream.read_to_write);
  }
}

void describe(Schema& schema, StreamConfig& config) {
  schema.integer("streams.default_depth", config.default_depth, {1, 65536}, "tokens",
                 "FIFO depth of every stream whose own depth is 0.", chosen("a distributed-memory FIFO"));
  std::vector<std::pair<std::string, FifoKind>> kinds;
  for (const FifoKind kind : {FifoKind::kRegistered, FifoKind::kFirstWordFallThrough, FifoKind::kBlockRam,
                              FifoKind::kAsynchronous, FifoKind::kFree}) {
    kinds.emplace_back(name_of(kind), kind);
  }
  schema.choice(
      "streams.default_kind", config.default_kind, kinds,
      "Kind of FIFO of every stream whose own kind is default: which cycle after the write it can be read "
      "in, and which after the read its place can be written in.",
      chosen("flags in registers close timing at any depth"));
  schema.integer(
      "streams.synchroniser_stages", config.synchroniser_stages, {1, 8}, "registers",
      "Synchroniser registers that each pointer of an asynchronous FIFO passes, where the stream has no "
      "delays of its own.",
      chosen("two are usual"));
  for (auto& [name, tokens] : config.depths) {
    schema.integer(
        "streams." + name + ".depth", tokens, {0, 1 << 24}, "tokens",
        "FIFO depth of the stream " + name +
            ". 0 is automatic: streams.default_depth, or more where paths that fork and meet again need it.",
        chosen("automatic"));
  }
  std::vector<std::pair<std::string, std::optional<FifoKind>>> own_kinds{{"default", std::nullopt}};
  own_kinds.insert(own_kinds.end(), kinds.begin(), kinds.end());
  for (StreamKind& stream : config.kinds) {
    schema.choice("streams." + stream.name + ".kind", stream.kind, own_kinds,
                  "Kind of FIFO of the stream " + stream.name + ". default is streams.default_kind.",
                  chosen("the default"));
    schema.integer(
        "streams." + stream.name + ".write_to_read", stream.write_to_read,
        {StreamKind::kOfTheKind, StreamKind::kMostEdges}, "edges",
        "Edges of the reader's clock from the write of a token until it can be read: of kind free, "
        "where 0 is the same cycle, and asynchronous, one more than synchroniser registers. -1 is "
        "that of the kind, 1 of free.",
        chosen("that of the kind"));
    schema.integer(
        "streams." + stream.name + ".read_to_write", stream.read_to_write,
        {StreamKind::kOfTheKind, StreamKind::kMostEdges}, "edges",
        "Edges of the writer's clock from the read of a token until its place can be written: of kind "
        "free, where 0 is the same cycle, and asynchronous, one more than synchroniser registers. -1 "
        "is that of the kind, 1 of free.",
        chosen("that of the kind"));
    schema.integer("streams." + stream.name + ".not_ready_cycles", stream.not_ready_cycles, {0, 65536},
                   "cycles", "Cycles of the writer's clock after reset in which the FIFO takes nothing yet.",
                   chosen("ready at once"));
  }
}

}  // namespace parallax
