// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

namespace parallax {

/// A file that is written under a temporary name and appears under its own name when it is complete. Unless
/// it is published, the destructor removes what was written. Every fault is a UserError with one line: the
/// file cannot be created, the disk is full, the name cannot be taken.
class OutputFile {
 public:
  OutputFile(std::filesystem::path temporary, std::filesystem::path target);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(const void* data, std::size_t bytes);
  void write(std::string_view text) { write(text.data(), text.size()); }

  /// Brings all data to the file system: after this, the disk cannot be too full any more.
  void close();

  /// Closes the file and gives it its name, in the place of an older file of that name.
  void publish();

 private:
  [[noreturn]] void fail(int error) const;

  std::filesystem::path temporary_;
  std::filesystem::path target_;
  std::FILE* file_ = nullptr;
  bool published_ = false;
};

}  // namespace parallax
