// SPDX-License-Identifier: Apache-2.0
#include "platform/registers/register_word.hpp"

#include <algorithm>
#include <stdexcept>

#include "platform/registers/register_map.hpp"

namespace parallax {

LocatedRegister find_register(const std::string& block, const std::string& reg) {
  for (const RegisterBlock& b : register_blocks()) {
    if (block != b.name) continue;
    for (const Register& r : b.registers) {
      if (reg == r.name) return {r, b.base + r.offset};
    }
  }
  throw std::logic_error("no register " + reg + " in block " + block);
}

std::uint32_t compose(const Register& reg, const std::vector<FieldValue>& values) {
  std::uint32_t word = 0;
  for (const FieldValue& entry : values) {
    const auto found = std::find_if(reg.fields.begin(), reg.fields.end(),
                                    [&](const RegisterField& f) { return entry.first == f.name; });
    if (found == reg.fields.end()) {
      throw std::logic_error("no field " + entry.first + " in register " + reg.name);
    }
    word |= entry.second << found->low & found->mask();
  }
  return word;
}

}  // namespace parallax
