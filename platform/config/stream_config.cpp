// SPDX-License-Identifier: Apache-2.0
#include "platform/config/stream_config.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "platform/config/disparity_filters.hpp"
#include "platform/config/schema.hpp"

namespace parallax {

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
  kinds.push_back({name, std::nullopt});
}

std::uint32_t StreamConfig::resolve(const std::string& name, std::uint32_t needed) const {
  const auto stream = std::find_if(depths.begin(), depths.end(),
                                   [&](const StreamDepth& depth) { return depth.name == name; });
  if (stream == depths.end()) throw std::logic_error("no stream is called " + name);
  return stream->tokens != 0 ? stream->tokens : std::max(default_depth, needed);
}

FifoKind StreamConfig::kind(const std::string& name) const {
  const auto stream =
      std::find_if(kinds.begin(), kinds.end(), [&](const StreamKind& kind) { return kind.name == name; });
  if (stream == kinds.end()) throw std::logic_error("no stream is called " + name);
  return stream->kind.value_or(default_kind);
}

void describe(Schema& schema, StreamConfig& config) {
  schema.integer("streams.default_depth", config.default_depth, {1, 65536}, "tokens",
                 "FIFO depth of every stream whose own depth is 0.", chosen("a distributed-memory FIFO"));
  std::vector<std::pair<std::string, FifoKind>> kinds;
  for (const FifoKind kind : {FifoKind::kRegistered, FifoKind::kFirstWordFallThrough, FifoKind::kBlockRam,
                              FifoKind::kAsynchronous}) {
    kinds.emplace_back(name_of(kind), kind);
  }
  schema.choice(
      "streams.default_kind", config.default_kind, kinds,
      "Kind of FIFO of every stream whose own kind is default: which cycle after the write it can be read "
      "in, and which after the read its place can be written in.",
      chosen("flags in registers close timing at any depth"));
  schema.integer("streams.synchroniser_stages", config.synchroniser_stages, {1, 8}, "registers",
                 "Synchroniser registers that each pointer of an asynchronous FIFO passes.",
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
  for (auto& [name, kind] : config.kinds) {
    schema.choice("streams." + name + ".kind", kind, own_kinds,
                  "Kind of FIFO of the stream " + name + ". default is streams.default_kind.",
                  chosen("the default"));
  }
}

}  // namespace parallax
