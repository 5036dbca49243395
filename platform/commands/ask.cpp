// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/ask.hpp"

#include <fmt/format.h>

#include "platform/commands/ask_best.hpp"
#include "platform/commands/ask_effect.hpp"
#include "platform/commands/ask_threshold.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

bool looks(const AskOptions& options) { return options.from || options.to; }

}  // namespace

int ask(const AskOptions& options, CommandContext& context) {
  if (options.which == "effect") {
    if (!options.holds.empty() || !options.run.vary.empty() || looks(options))
      throw UserError("ask effect: shows two runs; --hold, --vary, --from and --to are for least and most");
    return ask_effect(options, context);
  }
  if (options.which != "least" && options.which != "most")
    throw UserError(fmt::format("ask '{}': must be least, most or effect", excerpt(options.which)));
  if (options.subjects.size() != 1)
    throw UserError(fmt::format("ask {}: takes one key, or with --vary one number; there are {}",
                                options.which, options.subjects.size()));
  if (options.run.vary.empty()) return ask_threshold(options, context);
  if (looks(options)) throw UserError("--from and --to say where to look for a key; --vary has its values");
  return ask_best(options, context);
}

}  // namespace parallax
