// SPDX-License-Identifier: Apache-2.0
#include "platform/input/file_storage.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <vector>

#include "platform/input/input_file.hpp"
#include "tlm/error.hpp"

namespace parallax {

cv::FileStorage open_file_storage(const std::string& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  try {
    cv::FileStorage file(std::string(bytes.begin(), bytes.end()),
                         cv::FileStorage::READ | cv::FileStorage::MEMORY);
    if (file.isOpened() && file.root().isMap()) {
      return file;
    }
  } catch (const cv::Exception& error) {
    throw UserError(fmt::format("{}: not an OpenCV YAML, XML or JSON file: {}", path, error.err));
  }
  throw UserError(fmt::format("{}: not an OpenCV YAML, XML or JSON file", path));
}

}  // namespace parallax
