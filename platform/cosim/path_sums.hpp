// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "platform/cosim/token_comparison.hpp"
#include "platform/cosim/token_words.hpp"

namespace parallax {

/// `one_path`: a sum of path costs that differs as if one of the paths was left out, was added twice, or
/// stood in the place of another one. With S the sum of the paths' costs in `folder`, of which the model's
/// value is S >> s for one s: each value that differs is (S - L) >> s, or the lowest bits of (S + L) >> s or
/// of (S - L + L') >> s. Where several explain all that differ, each is named. Nothing of another stream, or
/// where the folder does not have the taps of all paths. Throws UserError for a tap that is damaged.
std::optional<DifferencePattern> find_one_path(const TokenComparison& comparison, const TokenWords& expected,
                                               const TokenWords& got, const std::filesystem::path& folder);

}  // namespace parallax
