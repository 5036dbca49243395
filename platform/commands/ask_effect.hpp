// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/commands/ask.hpp"

namespace parallax {

/// What these changes bring: a run without them beside one with them (ask()).
int ask_effect(const AskOptions& options, CommandContext& context);

}  // namespace parallax
