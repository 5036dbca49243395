// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "platform/cosim/token_comparison.hpp"
#include "platform/cosim/token_words.hpp"

namespace parallax {

/// `path_origin`: where a path's costs begin to differ. A cost that is wrong makes those of the pixels behind
/// it on the path wrong, of more and more disparities; looked at are the pixels that differ though the one
/// before them, wherever the path comes from at the rim (PathStart), does not. Says in which disparities,
/// rows or columns all of these lie; nothing where they lie everywhere, or of another stream.
std::optional<DifferencePattern> find_path_origin(const TokenComparison& comparison,
                                                  const TokenWords& expected, const TokenWords& got);

}  // namespace parallax
