// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace parallax {

struct CommandContext;

/// What the user asked `parallax explore` for.
struct ExploreOptions {
  std::filesystem::path spec;
  std::filesystem::path out;
  bool json = false;
};

/// Evaluates the points of a specification that the folder does not know, and says what they come to:
/// results.db, points.csv and front.csv. Returns 0; 1 when no point was done, or none satisfies the
/// constraints; 128 + the signal when SIGINT or SIGTERM stopped it, the finished points being there. Throws
/// UserError.
int explore(const ExploreOptions& options, CommandContext& context);

}  // namespace parallax
