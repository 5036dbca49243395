// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "platform/cosim/token_words.hpp"

namespace parallax {

/// Of each bit of a token, which one of the model's it is.
using BitPermutation = std::vector<std::size_t>;

/// The order of the bits that explains the tokens `at` of `got`, if each is the model's `late` before;
/// nothing where none does, or the bits' own does. Bits that are alike in all of these tokens stay where they
/// are, if they can. Needs 64 of them at least; more are not chance.
std::optional<BitPermutation> find_bit_permutation(const TokenWords& expected, const TokenWords& got,
                                                   std::int64_t late, const std::vector<std::uint64_t>& at);

/// Whether a token is the model's with its bits in that order.
bool is_permuted(const BitPermutation& permutation, const TokenWords& expected, std::uint64_t from,
                 const TokenWords& got, std::uint64_t at);

/// "the bits are rotated up by 3", or of the first ones which they are.
std::string text(const BitPermutation& permutation);

}  // namespace parallax
