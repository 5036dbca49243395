// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace parallax {

struct CommandContext;

/// What the user asked `parallax explore` for.
struct ExploreOptions {
  std::filesystem::path spec;
  std::filesystem::path out;
  bool json = false;
  std::string shard;  ///< "2/4"; empty: all points
  std::string emit;   ///< the engine for which a job is written, in place of a run (JobEngine); empty: none
  std::size_t tasks = 0;  ///< of that job
};

/// What the user asked `parallax merge` for.
struct MergeOptions {
  std::filesystem::path spec;
  std::filesystem::path out;
  std::vector<std::filesystem::path> folders;
  bool json = false;
};

/// Evaluates the points of a specification that the folder does not know, and says what they come to:
/// results.db, points.csv, front.csv, and sensitivity.csv of one that varies one at a time. Returns 0; but
/// for a shard 1 when no point was done, or none satisfies the constraints; 128 + the signal when SIGINT or
/// SIGTERM stopped it, the finished points being there. Throws UserError.
int explore(const ExploreOptions& options, CommandContext& context);

/// Takes what these folders of one exploration have into one, and says what it comes to, as explore() does;
/// evaluates nothing. Returns 0; 1 when points are missing, or none satisfies the constraints. Throws
/// UserError.
int merge(const MergeOptions& options, CommandContext& context);

}  // namespace parallax
