// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "platform/results/file_content.hpp"

namespace parallax {

/// A file that is written under a temporary name in the same folder and appears under its own name when it is
/// complete. Unless it is published, the destructor removes what was written. Every fault is a UserError with
/// one line: the file cannot be created, the disk is full, the name cannot be taken. A target that is a
/// device or a pipe is written directly: a file must not take its place.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path target);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(const void* data, std::size_t bytes);
  void write(std::string_view text) { write(text.data(), text.size()); }

  /// Brings all data to the file system: after this, the disk cannot be too full any more.
  void close();

  /// Closes the file and gives it its name, in the place of an older file of that name.
  void publish();

  const std::filesystem::path& target() const { return target_; }
  /// Of what was written until now.
  const FileContent& content() const { return content_; }

 private:
  void open_temporary();
  void discard();
  [[noreturn]] void fail(int error) const;

  std::filesystem::path target_;
  std::filesystem::path temporary_;  ///< empty when the target is written directly
  std::FILE* file_ = nullptr;
  int lock_ = -1;  ///< a descriptor that keeps the temporary file locked: who wrote it lives
  FileContent content_;
  bool published_ = false;
};

/// The name of the file that `name` is a temporary file of; empty when it is none.
std::string target_of_temporary(const std::string& name);
/// Removes a temporary file whose writer does not live any more, on whichever machine that was; others stay.
/// Says whether it did.
bool remove_if_abandoned(const std::filesystem::path& temporary);

/// Removes the temporary files of `target` that are abandoned.
void remove_abandoned_of(const std::filesystem::path& target);

/// A whole file at once: the old one or the new one, never a part. Temporary files that an earlier attempt at
/// it left are removed.
void write_file(const std::filesystem::path& target, std::string_view content);
void write_file(const std::filesystem::path& target, const std::vector<std::uint8_t>& content);

}  // namespace parallax
