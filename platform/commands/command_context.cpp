// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/command_context.hpp"

#include "platform/results/progress.hpp"

namespace parallax {

bool shows_progress(const CommandContext& context) {
  return context.progress && context.verbosity != Verbosity::kQuiet && standard_error_is_terminal();
}

}  // namespace parallax
