// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "platform/cosim/token_comparison.hpp"
#include "platform/cosim/token_words.hpp"

namespace parallax {

/// Of disparities, whether the circuit never has the model's least one or its greatest one (whole px), and
/// differs where the model has it and nowhere else: a disparity that never wins (`disparity_never_wins`).
/// Needs kLeastMoved tokens that differ.
std::optional<DifferencePattern> find_absent_disparity(const TokenComparison& comparison,
                                                       const TokenWords& expected, const TokenWords& got);

}  // namespace parallax
