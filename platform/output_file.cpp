// SPDX-License-Identifier: Apache-2.0
#include "platform/output_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

#include "tlm/error.hpp"

namespace parallax {

OutputFile::OutputFile(std::filesystem::path temporary, std::filesystem::path target)
    : temporary_(std::move(temporary)), target_(std::move(target)) {
  std::error_code ignored;
  if (std::filesystem::is_directory(target_, ignored)) fail(EISDIR);
  file_ = std::fopen(temporary_.c_str(), "wb");
  if (!file_) fail(errno);
}

OutputFile::~OutputFile() {
  if (file_) std::fclose(file_);
  std::error_code ignored;
  if (!published_) std::filesystem::remove(temporary_, ignored);
}

void OutputFile::write(const void* data, std::size_t bytes) {
  if (bytes > 0 && std::fwrite(data, 1, bytes, file_) != bytes) fail(errno);
}

void OutputFile::close() {
  if (!file_) return;
  std::FILE* file = file_;
  file_ = nullptr;
  if (std::fclose(file) != 0) fail(errno);
}

void OutputFile::publish() {
  close();
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  published_ = true;
}

void OutputFile::fail(int error) const {
  throw UserError(fmt::format("cannot write {}: {}", target_.string(), std::strerror(error)));
}

}  // namespace parallax
