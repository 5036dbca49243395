// SPDX-License-Identifier: Apache-2.0
#include "platform/results/output_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "tlm/error.hpp"

namespace parallax {

namespace fs = std::filesystem;

OutputFile::OutputFile(fs::path target) : target_(std::move(target)) {
  std::error_code ignored;
  const fs::file_status status = fs::status(target_, ignored);
  if (fs::is_directory(status)) fail(EISDIR);
  if (!fs::exists(status) || fs::is_regular_file(status)) {
    // Hidden, and with the process number: two runs into one folder do not meet.
    temporary_ = target_.parent_path() / fmt::format(".{}.{}.part", target_.filename().string(), ::getpid());
  }
  file_ = std::fopen(temporary_.empty() ? target_.c_str() : temporary_.c_str(), "wb");
  if (!file_) fail(errno);
}

OutputFile::~OutputFile() {
  if (file_) std::fclose(file_);
  std::error_code ignored;
  if (!published_ && !temporary_.empty()) fs::remove(temporary_, ignored);
}

void OutputFile::write(const void* data, std::size_t bytes) {
  if (bytes > 0 && std::fwrite(data, 1, bytes, file_) != bytes) fail(errno);
}

void OutputFile::close() {
  if (!file_) return;
  std::FILE* file = file_;
  file_ = nullptr;
  // Network file systems report a full disk as late as here.
  if (std::fclose(file) != 0) fail(errno);
}

void OutputFile::publish() {
  close();
  if (!temporary_.empty() && std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  published_ = true;
}

void OutputFile::fail(int error) const {
  throw UserError(fmt::format("cannot write {}: {}", target_.string(), std::strerror(error)));
}

void write_file(const fs::path& target, std::string_view content) {
  OutputFile file(target);
  file.write(content);
  file.publish();
}

void write_file(const fs::path& target, const std::vector<std::uint8_t>& content) {
  write_file(target, std::string_view(reinterpret_cast<const char*>(content.data()), content.size()));
}

}  // namespace parallax
