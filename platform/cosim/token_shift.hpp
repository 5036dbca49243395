// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "platform/cosim/token_comparison.hpp"
#include "platform/cosim/token_words.hpp"

namespace parallax {

/// Whether all of a stream is the model's some tokens late or early, in each row or over all of them.
/// `differing`: the first tokens that differ; of kLeastMoved or more, else nothing is found.
std::vector<DifferencePattern> find_delay(const TokenComparison& comparison, const TokenWords& expected,
                                          const TokenWords& got, const std::vector<std::uint64_t>& differing);

/// Whether a stream is the model's some columns and rows (8 px each at most) late or early but for a rim of
/// 16 px, or a quarter of the image, at most; at least kLeastMoved tokens inside it must differ.
std::vector<DifferencePattern> find_moved(const TokenComparison& comparison, const TokenWords& expected,
                                          const TokenWords& got);

}  // namespace parallax
