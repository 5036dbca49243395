// SPDX-License-Identifier: Apache-2.0
#include "platform/config/stream_config.hpp"

#include <algorithm>
#include <stdexcept>

#include "platform/config/schema.hpp"

namespace parallax {

const std::vector<std::string>& pipeline_stream_names() {
  static const std::vector<std::string> names{
      "left_pixels",     "right_pixels",     "map_words",         "map_entries",  "left_rectified",
      "right_rectified", "left_texture",     "left_output",       "left_codes",   "right_codes",
      "costs_subpixel",  "costs_uniqueness", "costs_consistency", "winners",      "unique",
      "consistent",      "textured",         "despeckled",        "interpolated", "smoothed"};
  return names;
}

StreamConfig::StreamConfig(const std::vector<std::string>& names) {
  for (const std::string& name : names) depths.push_back({name, 0});
}

std::uint32_t StreamConfig::resolve(const std::string& name, std::uint32_t needed) const {
  const auto stream = std::find_if(depths.begin(), depths.end(),
                                   [&](const StreamDepth& depth) { return depth.name == name; });
  if (stream == depths.end()) throw std::logic_error("no stream is called " + name);
  return stream->tokens != 0 ? stream->tokens : std::max(default_depth, needed);
}

void describe(Schema& schema, StreamConfig& config) {
  schema.integer("streams.default_depth", config.default_depth, {1, 65536}, "tokens",
                 "FIFO depth of every stream whose own depth is 0.", chosen("a distributed-memory FIFO"));
  for (auto& [name, tokens] : config.depths) {
    schema.integer(
        "streams." + name + ".depth", tokens, {0, 1 << 24}, "tokens",
        "FIFO depth of the stream " + name +
            ". 0 is automatic: streams.default_depth, or more where paths that fork and meet again need it.",
        chosen("automatic"));
  }
}

}  // namespace parallax
