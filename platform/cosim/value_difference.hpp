// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "platform/cosim/token_comparison.hpp"
#include "platform/cosim/token_words.hpp"
#include "platform/cosim/vector_manifest.hpp"

namespace parallax {

/// What the values that differ have in common, wherever they lie: of disparities, that only which are valid
/// differs; of others, that they are off by 1, or that the lowest bits are right. Nothing if some are
/// unknown.
std::optional<DifferencePattern> find_value_difference(const VectorStream& stream, const TokenWords& expected,
                                                       const TokenWords& got);

}  // namespace parallax
