// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/difference_pattern.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "platform/cosim/absent_disparity.hpp"
#include "platform/cosim/difference_region.hpp"
#include "platform/cosim/frame_order.hpp"
#include "platform/cosim/frame_patterns.hpp"
#include "platform/cosim/joint_pattern.hpp"
#include "platform/cosim/lost_tokens.hpp"
#include "platform/cosim/path_origin.hpp"
#include "platform/cosim/pattern_evidence.hpp"
#include "platform/cosim/stream_end.hpp"
#include "platform/cosim/token_shift.hpp"
#include "platform/cosim/value_difference.hpp"
#include "platform/cosim/value_mapping.hpp"

namespace parallax {
namespace {

using Patterns = std::vector<DifferencePattern>;

// "path nw" of path_nw.
std::string words_of(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

void append(Patterns& all, const std::optional<DifferencePattern>& one) {
  if (one) all.push_back(*one);
}

std::vector<std::uint64_t> first_different(const TokenComparison& comparison, const TokenWords& expected,
                                           const TokenWords& got) {
  std::vector<std::uint64_t> tokens;
  for (std::uint64_t i = 0; i < comparison.compared_tokens && tokens.size() < kSamples; ++i) {
    if (!got.same(i, expected, i)) tokens.push_back(i);
  }
  return tokens;
}

bool are_all_the_same(const TokenWords& words) {
  for (std::uint64_t token = 1; token < words.size(); ++token) {
    if (!words.same(token, words, 0)) return false;
  }
  return true;
}

// Whether the model's tokens before the first one that differs, two or more, are the same, as in a masked
// border.
bool begins_alike(const TokenComparison& comparison, const TokenWords& expected) {
  const std::uint64_t first = comparison.first->token;
  for (std::uint64_t token = 1; token < first; ++token) {
    if (!expected.same(token, expected, 0)) return false;
  }
  return first > 1;
}

// What every token is, of the model's there or elsewhere.
Patterns of_all_tokens(const TokenComparison& comparison, const TokenWords& expected, const TokenWords& got) {
  if (comparison.unknown_tokens == comparison.different_tokens)
    return {{"unknown_bits", "all that differ have unknown bits (x or z)"}};
  if (comparison.different_tokens < kLeastExplained) return {};
  if (are_all_the_same(got)) return {{"constant", "all its tokens are the same"}};
  const std::vector<std::uint64_t> differing = first_different(comparison, expected, got);
  // A delay leaves the length as it is; where the image begins with tokens that are alike, it looks like one
  // or a row of them too many.
  const bool is_as_long = comparison.got_tokens == comparison.expected_tokens;
  Patterns found;
  // Where all tokens before the first one that differs are alike, a delay of more or fewer tokens than the
  // model's begins with a token lost or too many there, too.
  const bool may_be_delay = is_as_long || begins_alike(comparison, expected);
  if (may_be_delay) found = find_delay(comparison, expected, got, differing);
  if (found.empty()) append(found, find_frame_order(comparison, expected, got));
  if (found.empty()) found = find_lost_tokens(comparison, expected, got, differing);
  if (found.empty() && !may_be_delay) found = find_delay(comparison, expected, got, differing);
  if (found.empty()) found = find_moved(comparison, expected, got);
  if (found.empty()) append(found, find_value_mapping(comparison, expected, got, differing));
  if (found.empty()) append(found, find_absent_disparity(comparison, expected, got));
  if (found.empty()) append(found, find_path_origin(comparison, expected, got));
  if (found.empty()) found = find_joint_patterns(comparison, expected, got);
  return found;
}

void forget(Patterns& patterns, const std::set<std::string>& names) {
  patterns.erase(std::remove_if(patterns.begin(), patterns.end(),
                                [&names](const auto& pattern) { return names.count(pattern.name) > 0; }),
                 patterns.end());
}

Patterns find(const TokenComparison& comparison, const TokenWords& expected, const TokenWords& got) {
  if (comparison.different_tokens == 0) return find_end(comparison);
  Patterns found = of_all_tokens(comparison, expected, got);
  if (found.empty() && comparison.different_tokens == 1 &&
      comparison.got_tokens == comparison.expected_tokens && comparison.disparities.empty())
    return {{"one_token", "one token alone"}};
  DifferenceRegions regions = find_regions(comparison, expected, got);
  // What is known of every token says why some lines are equal.
  if (!found.empty()) forget(regions.patterns, {"all_but_rim", "rows_after_first", "columns_after_first"});
  // Which values are invalid says more than where they lie, unless that is a border.
  const Patterns validity = found.empty() ? find_validity(*comparison.stream, expected, got) : Patterns{};
  const bool is_validity_first =
      !regions.is_small || (!validity.empty() && validity.front().name == "invalid_as");
  if (is_validity_first) found.insert(found.end(), validity.begin(), validity.end());
  if (found.empty() && !regions.is_small) append(found, find_constant_end(comparison, got));
  // A border with bits of its own says more than which they are; elsewhere these do.
  if (found.empty() && !regions.is_small) append(found, find_one_way_bits(*comparison.stream, expected, got));
  found.insert(found.end(), regions.patterns.begin(), regions.patterns.end());
  if (!is_validity_first) found.insert(found.end(), validity.begin(), validity.end());
  if (found.empty() && comparison.different_tokens >= kLeastExplained)
    append(found, find_value_difference(*comparison.stream, expected, got));
  if (found.empty() && comparison.different_tokens == 1) found = {{"one_token", "one token alone"}};
  const bool are_frames_alone = std::all_of(found.begin(), found.end(), [](const DifferencePattern& pattern) {
    return pattern.name == "frames_after_first" || pattern.name == "only_first_frame";
  });
  if (are_frames_alone) {
    const Patterns of_frames = find_frame_patterns(comparison, expected, got);
    found.insert(found.end(), of_frames.begin(), of_frames.end());
  }
  if (found.empty()) found = {{"none", "none of those known: scattered over the image"}};
  return found;
}

}  // namespace

std::vector<DifferencePattern> find_patterns(const TokenComparison& comparison, const TokenWords& expected,
                                             const TokenWords& got) {
  Patterns found = find(comparison, expected, got);
  if (!comparison.stream->is_tap) return found;
  for (DifferencePattern& pattern : found)
    pattern.text = words_of(comparison.stream->name) + ": " + pattern.text;
  return found;
}

}  // namespace parallax
