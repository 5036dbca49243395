// SPDX-License-Identifier: Apache-2.0
#include "platform/images/stderr_capture.hpp"

#include <unistd.h>

namespace parallax {

StderrCapture::StderrCapture() : file_(std::tmpfile()), original_(-1) {
  // Where there is no room for a temporary file, the messages appear on the terminal: a blemish, not a fault.
  if (file_ != nullptr) {
    std::fflush(stderr);
    original_ = ::dup(STDERR_FILENO);
    ::dup2(::fileno(file_), STDERR_FILENO);
  }
}

StderrCapture::~StderrCapture() {
  if (file_ != nullptr) {
    std::fflush(stderr);
    if (original_ >= 0) {
      ::dup2(original_, STDERR_FILENO);
      ::close(original_);
    }
    std::fclose(file_);
  }
}

std::string StderrCapture::text() const {
  std::string result;
  if (file_ == nullptr) {
    return result;
  }
  std::fflush(stderr);
  // pread leaves the position alone, which is also where the next message goes.
  char buffer[512];
  for (ssize_t got = 0; (got = ::pread(::fileno(file_), buffer, sizeof buffer, result.size())) > 0;) {
    result.append(buffer, got);
  }
  return result;
}

}  // namespace parallax
