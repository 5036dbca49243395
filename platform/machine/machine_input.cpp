// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/machine_input.hpp"

#include <fmt/format.h>

#include <utility>

#include "tlm/error.hpp"

namespace parallax {

void MachineInput::bind_stage(const std::string& name, StageFactory make) {
  if (!make) throw UserError(fmt::format("stage '{}': nothing is given to stand in its place", name));
  if (!replacements.emplace(name, std::move(make)).second)
    throw UserError(fmt::format("stage '{}': something stands in its place already", name));
}

}  // namespace parallax
