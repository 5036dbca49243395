// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace parallax {

/// A signal, or bits of it that lie beside each other, as a user says: NAME, NAME[BIT] or NAME[HIGH:LOW].
struct NamedBits {
  std::string name;                                          ///< may have scopes, "gen[0].unit.tdata"
  std::optional<std::pair<std::size_t, std::size_t>> range;  ///< HIGH and LOW; none: all
};

/// None: what is in the brackets is no range, or they are not closed.
std::optional<NamedBits> read_named_bits(const std::string& word);

/// Whether tokens of `width` bits are the lower ones of a signal of this name and width: an AXI stream's
/// tdata is whole bytes.
bool is_padded_tdata(const std::string& name, std::size_t signal_width, std::size_t width);

/// Whether the name is `ending`, or ends so.
bool ends_with(const std::string& name, const std::string& ending);

}  // namespace parallax
