// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "platform/evaluation/evaluation_result.hpp"
#include "platform/explore/explorer.hpp"
#include "platform/explore/result_store.hpp"
#include "platform/results/output_folder.hpp"

namespace parallax {

/// The folder of a sweep: point_0000/timing.json and so on, and results.db, which says what was done; nothing
/// that is there is removed. A sweep that was interrupted goes on in it.
class SweepFolder {
 public:
  /// `text`: what is swept, the same for the same sweep. Throws UserError: the folder is of another one.
  SweepFolder(const std::filesystem::path& folder, const FolderPlan& plan, const std::string& text,
              const std::vector<std::string>& names);

  /// Whether any point is there.
  bool begun() const { return begun_; }
  /// Whether a point is there, with the result of the same machine on the same input.
  bool knows(std::size_t point, const PointIdentity& what);
  /// That result; nothing where its file has gone.
  std::optional<EvaluationResult> result(std::size_t point);
  /// Adds a result; `relaxations`: the file of that name, if any.
  void keep(std::size_t point, const std::vector<std::string>& values, const PointIdentity& what,
            const EvaluationResult& result, const std::string& relaxations);
  /// All points are there.
  void end() { store_.end(); }

 private:
  OutputFolder folder_;
  ResultStore store_;
  bool begun_;
};

}  // namespace parallax
