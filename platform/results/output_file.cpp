// SPDX-License-Identifier: Apache-2.0
#include "platform/results/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <regex>
#include <utility>

#include "tlm/error.hpp"

namespace parallax {

namespace fs = std::filesystem;

OutputFile::OutputFile(fs::path target) : target_(std::move(target)) {
  std::error_code ignored;
  const fs::file_status status = fs::status(target_, ignored);
  if (fs::is_directory(status)) fail(EISDIR);
  if (!fs::exists(status) || fs::is_regular_file(status)) {
    open_temporary();
  } else {
    file_ = std::fopen(target_.c_str(), "wb");
    if (!file_) fail(errno);
  }
}

OutputFile::~OutputFile() {
  if (file_) std::fclose(file_);
  discard();
}

// Hidden, and with the process number: two runs into one folder do not meet. The lock ends with the process,
// however that ends: what is not locked is abandoned. A process number may be of another machine or come
// again, so a name can be taken.
void OutputFile::open_temporary() {
  constexpr std::int64_t kProcessNumbers = std::int64_t{1} << 22;  // of Linux, at most
  for (std::int64_t number = ::getpid();;) {
    temporary_ = target_.parent_path() / fmt::format(".{}.{}.part", target_.filename().string(), number);
    const int descriptor = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0) {
      const int error = errno;
      if (error != EEXIST) {
        temporary_.clear();
        fail(error);
      }
      if (!remove_if_abandoned(temporary_)) number += kProcessNumbers;
      continue;
    }
    ::flock(descriptor, LOCK_EX);  // where there are no locks, nothing ever counts as abandoned
    struct stat status {};
    if (::fstat(descriptor, &status) == 0 && status.st_nlink == 0) {  // removed before it was locked
      ::close(descriptor);
      continue;
    }
    lock_ = ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
    file_ = ::fdopen(descriptor, "wb");
    if (file_ != nullptr && lock_ >= 0) return;
    const int error = errno;
    if (file_ == nullptr) ::close(descriptor);
    discard();
    fail(error);
  }
}

void OutputFile::discard() {
  std::error_code ignored;
  if (!published_ && !temporary_.empty()) fs::remove(temporary_, ignored);
  if (lock_ >= 0) ::close(std::exchange(lock_, -1));
}

void OutputFile::write(const void* data, std::size_t bytes) {
  if (bytes > 0 && std::fwrite(data, 1, bytes, file_) != bytes) fail(errno);
  content_.add(data, bytes);
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
  discard();
}

void OutputFile::fail(int error) const {
  throw UserError(fmt::format("cannot write {}: {}", target_.string(), std::strerror(error)));
}

std::string target_of_temporary(const std::string& name) {
  static const std::regex temporary("\\.(.+)\\.[0-9]+\\.part");
  std::smatch parts;
  return std::regex_match(name, parts, temporary) ? parts[1].str() : "";
}

bool remove_if_abandoned(const fs::path& temporary) {
  const int descriptor = ::open(temporary.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return false;
  struct stat status {};
  const bool abandoned = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) &&
                         ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  const bool removed = abandoned && ::unlink(temporary.c_str()) == 0;
  ::close(descriptor);
  return removed;
}

void remove_abandoned_of(const fs::path& target) {
  std::error_code ignored;
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  for (fs::directory_iterator entry(folder, ignored), end; entry != end; entry.increment(ignored)) {
    if (target_of_temporary(entry->path().filename().string()) == target.filename().string())
      remove_if_abandoned(entry->path());
  }
}

void write_file(const fs::path& target, std::string_view content) {
  remove_abandoned_of(target);
  OutputFile file(target);
  file.write(content);
  file.publish();
}

void write_file(const fs::path& target, const std::vector<std::uint8_t>& content) {
  write_file(target, std::string_view(reinterpret_cast<const char*>(content.data()), content.size()));
}

}  // namespace parallax
