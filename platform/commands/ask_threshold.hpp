// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/commands/ask.hpp"

namespace parallax {

/// The least (or most) value of a key with which a machine holds all bounds (ask()).
int ask_threshold(const AskOptions& options, CommandContext& context);

}  // namespace parallax
