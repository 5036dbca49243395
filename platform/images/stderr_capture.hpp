// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <string>

namespace parallax {

/// Keeps what is written to the process's standard error while it lives. The image decoders' libraries print
/// there what is wrong with a file, and know no other way to say it. Messages of other threads are kept too,
/// so it lives for the decoding of one image only.
class StderrCapture {
 public:
  StderrCapture();
  ~StderrCapture();
  StderrCapture(const StderrCapture&) = delete;
  StderrCapture& operator=(const StderrCapture&) = delete;

  /// What has been written so far.
  std::string text() const;

 private:
  std::FILE* file_;
  int original_;
};

}  // namespace parallax
