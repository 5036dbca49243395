// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tlm/register_bank.hpp"

namespace parallax {

/// A register of the core's control blocks (register_map.hpp), and where it lies.
struct LocatedRegister {
  const Register& description;
  std::uint32_t address;  ///< B, within the control blocks
};

/// Throws std::logic_error when there is none of that name.
LocatedRegister find_register(const std::string& block, const std::string& reg);

/// A field's name and what it is to hold.
using FieldValue = std::pair<std::string, std::uint32_t>;

/// The word with these fields, all others 0. A value's bits beyond the field are left out. Throws
/// std::logic_error for a field that the register does not have.
std::uint32_t compose(const Register& reg, const std::vector<FieldValue>& values);

}  // namespace parallax
