// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>
#include <stdexcept>
#include <string>
#include <systemc>
#include <type_traits>

#include "tests/timing/in_child.hpp"

namespace parallax::bench {

/// What `action` returns, a plain struct, from a process of its own: a process can hold one SystemC
/// simulation only. Throws std::runtime_error with what went wrong there.
template <class Action>
auto child_value(const Action& action) {
  using Value = decltype(action());
  static_assert(std::is_trivially_copyable_v<Value>, "travels as bytes");
  constexpr char kGood = '\1';
  const std::string text = test::in_child([&] {
    sc_core::sc_report_handler::set_actions(sc_core::SC_INFO, sc_core::SC_DO_NOTHING);
    const Value value = action();
    std::string bytes(1 + sizeof value, kGood);
    std::memcpy(&bytes[1], &value, sizeof value);
    return bytes;
  });
  if (text.size() != 1 + sizeof(Value) || text[0] != kGood) throw std::runtime_error(text);
  Value value;
  std::memcpy(&value, &text[1], sizeof value);
  return value;
}

}  // namespace parallax::bench
