// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "platform/results/file_identity.hpp"
#include "platform/results/file_index.hpp"
#include "platform/results/folder_lock.hpp"
#include "platform/results/output_file.hpp"

namespace parallax {

/// What a command is going to do to the folder of its results. Names are paths in the folder, at most one
/// folder deep.
struct FolderPlan {
  using Names = std::function<bool(const std::string& name)>;

  Names writes = [](const std::string&) { return false; };    ///< files that it may write
  Names replaces = [](const std::string&) { return false; };  ///< results of earlier commands that are to go
  std::vector<NamedInput> inputs{};                           ///< what it reads
};

/// The folder of a run's results. Files are opened or written in any order and appear together at publish():
/// a reader sees the whole set of a frame or none of it. What was not published when the folder is destroyed
/// is removed, and so is a folder that this object made and that stayed empty. Nothing that this program did
/// not write there is replaced or removed (FileIndex), and nothing that is an input. One writes there at a
/// time (FolderLock).
class OutputFolder {
 public:
  /// Makes the folder if need be. Throws UserError when that fails, when a file has that name, when the
  /// folder cannot be written to, when another process writes there, or when what is planned would cost a
  /// file that is an input or was not written by this program: before any work is done, not after. Removes
  /// what earlier commands left half written there.
  explicit OutputFolder(std::filesystem::path path, FolderPlan plan = {});
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// A file of the next publish(); `name` may lie in a subfolder, which is made. The reference is good until
  /// then.
  OutputFile& open(const std::string& name);

  /// A whole file of the next publish().
  void write(const std::string& name, std::string_view content);
  void write(const std::string& name, const std::vector<unsigned char>& content);

  /// Completes all files, then gives each its name; the first time, results of earlier commands that are to
  /// go are removed: what a reader finds then is of one run. Throws UserError when the disk is full, or when
  /// somebody else's file has taken a name meanwhile; then none appears.
  void publish();
  /// The same for the files that are written as a whole: those that were opened go on.
  void publish_written();

 private:
  std::unique_ptr<OutputFile> create(const std::string& name);
  void publish(const std::vector<std::unique_ptr<OutputFile>>& files);
  void make(const std::filesystem::path& folder);
  void prepare();
  void remove_abandoned();
  void check_inputs(const std::vector<std::string>& names) const;
  void check_writable(const std::string& name) const;
  std::string name_of(const OutputFile& file) const;
  void remove_old();
  void remove_made();  ///< those that are empty

  std::filesystem::path path_;
  std::optional<FolderLock> lock_;
  FolderPlan plan_;
  std::vector<std::string> old_;  ///< results that go at the first publish()
  std::optional<FileIndex> index_;
  std::vector<std::filesystem::path> made_;  ///< folders that did not exist before, outermost first
  std::vector<std::unique_ptr<OutputFile>> opened_, written_;  ///< of the next publish()
};

}  // namespace parallax
