// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace parallax {

/// The script of a job whose tasks each explore a shard, for an engine that is there: "slurm", "parallel"
/// (GNU Parallel), "lsf" or "sge". A task that is ended and started again goes on where it was, in its
/// shard's folder; what it says is appended to a file there, whatever the engine does to its own.
class JobScript {
 public:
  /// Throws UserError: no such engine, or more tasks than it takes.
  JobScript(const std::string& engine, const std::filesystem::path& spec, const std::filesystem::path& out,
            std::size_t tasks);

  std::string name() const;  ///< of the file, in the folder of the results
  std::string text() const;
  std::string submit() const;  ///< the line that starts it
  std::string merge() const;   ///< the line for afterwards

 private:
  struct Engine;
  static const Engine& find(const std::string& name);

  const Engine& engine_;
  const std::filesystem::path spec_, out_;
  const std::size_t tasks_;
};

}  // namespace parallax
