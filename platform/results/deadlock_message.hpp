// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "platform/machine.hpp"

namespace parallax {

/// Why a machine that has run dry before the host had all frames cannot go on: who waits for whom. Several
/// lines.
std::string deadlock_message(const Machine& machine);

}  // namespace parallax
