// SPDX-License-Identifier: Apache-2.0
#include "platform/images/image_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <opencv2/core.hpp>

#include "platform/files/article.hpp"
#include "platform/images/image_codecs.hpp"
#include "platform/images/image_header.hpp"
#include "platform/images/stderr_capture.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

namespace fs = std::filesystem;

// The image, or an empty one when it is damaged.
cv::Mat decode(const std::string& path) {
  const StderrCapture capture;
  cv::Mat image;
  try {
    image = read_image(path);
  } catch (const cv::Exception&) {
    return {};
  }
  // The JPEG decoder fills the missing part of a truncated file with grey and only warns.
  const std::string complaint = capture.text();
  const bool damaged = complaint.find("Corrupt JPEG") != std::string::npos ||
                       complaint.find("Premature end") != std::string::npos;
  return damaged ? cv::Mat() : image;
}

}  // namespace

void require_image_file(const std::string& path, const std::string& what) {
  std::error_code failed;
  const fs::file_status status = fs::status(path, failed);
  if (status.type() == fs::file_type::not_found)
    throw UserError(fmt::format("{} {} does not exist", what, path));
  if (failed) throw UserError(fmt::format("cannot read {} {}: {}", what, path, failed.message()));
  if (fs::is_directory(status))
    throw UserError(fmt::format("{} is a folder, expected {}", path, with_article(what)));
  if (!fs::is_regular_file(status))
    throw UserError(fmt::format("{} is no file, expected {}", path, with_article(what)));
  if (::faccessat(AT_FDCWD, path.c_str(), R_OK, AT_EACCESS) != 0)
    throw UserError(fmt::format("cannot read {} {}: {}", what, path, std::strerror(errno)));
}

SizeCheck at_most_any_image(const std::string& path, const std::string& what) {
  return [=](const cv::Size& size) {
    constexpr std::int64_t kMost = std::int64_t{1} << 28;
    if (std::int64_t{size.width} * size.height <= kMost) return;
    throw UserError(fmt::format("{} {} is {}, larger than the largest size of {} px", what, path,
                                size_text(size), kMost));
  };
}

cv::Mat read_image_file(const std::string& path, const std::string& what, const SizeCheck& check) {
  require_image_file(path, what);
  cv::Mat image;
  if (const auto size = image_size_of_header(path)) {
    check(*size);
    image = decode(path);
    if (image.size() != *size) image.release();
  }
  if (image.empty()) {
    throw UserError(fmt::format(
        "cannot read {} {}: it is damaged, or not a PNG, JPEG, TIFF, BMP, PNM or WebP file", what, path));
  }
  return image;
}

std::string size_text(const cv::Size& size) { return fmt::format("{}x{}", size.width, size.height); }

}  // namespace parallax
