// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/frame_patterns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace parallax {
namespace {

TokenWords part(const TokenWords& words, std::uint64_t from, std::uint64_t to) {
  return words.part(std::min(from, words.size()), std::min(to, words.size()));
}

bool explains(const DifferencePattern& pattern) {
  return pattern.name != "none" && pattern.name != "one_token" && pattern.name != "truncated" &&
         pattern.name != "surplus";
}

}  // namespace

std::vector<DifferencePattern> find_frame_patterns(const TokenComparison& comparison,
                                                   const TokenWords& expected, const TokenWords& got) {
  const VectorManifest& manifest = *comparison.manifest;
  const VectorStream& stream = *comparison.stream;
  const std::uint64_t tokens = stream.frame_tokens;
  if (manifest.frames < 2 || tokens == 0) return {};
  std::vector<DifferencePattern> all;
  for (std::int64_t frame = 0; frame < manifest.frames; ++frame) {
    VectorManifest one = manifest;
    one.frames = 1;
    one.first_frame = manifest.first_frame + frame;
    one.streams = {stream};
    VectorStream& its = one.streams.front();
    its.tokens = tokens;
    its.is_tap = false;  // its name is said once, before what all frames have
    const std::uint64_t from = static_cast<std::uint64_t>(frame) * tokens;
    const bool is_last = frame + 1 == manifest.frames;
    const TokenComparison alone = compare_tokens(one, its, part(expected, from, from + tokens),
                                                 {part(got, from, is_last ? got.size() : from + tokens), {}});
    if (alone.equal()) continue;
    DifferencePattern pattern = alone.patterns.front();
    pattern.frame = one.first_frame;
    all.push_back(pattern);
  }
  if (!std::any_of(all.begin(), all.end(), explains)) return {};
  const bool are_alike = std::all_of(all.begin(), all.end(), [&all](const DifferencePattern& pattern) {
    return pattern.name == all.front().name && pattern.text == all.front().text;
  });
  if (are_alike && all.size() == static_cast<std::size_t>(manifest.frames))
    return {{all.front().name, all.front().text + ", in each frame anew"}};
  for (DifferencePattern& pattern : all)
    pattern.text = fmt::format("frame {}: {}", *pattern.frame, pattern.text);
  std::stable_partition(all.begin(), all.end(), explains);
  return all;
}

}  // namespace parallax
