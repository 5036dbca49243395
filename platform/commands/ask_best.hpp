// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/commands/ask.hpp"

namespace parallax {

/// Of the machines of a grid the one with the least (or most) of a number, or of a key that varies, that
/// holds all bounds (ask()).
int ask_best(const AskOptions& options, CommandContext& context);

}  // namespace parallax
