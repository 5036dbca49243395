// SPDX-License-Identifier: Apache-2.0
#include "platform/input/file_storage.hpp"

#include <fmt/format.h>

#include <set>
#include <stdexcept>

#include "platform/input/nesting_depth.hpp"
#include "platform/input/opencv_yaml.hpp"
#include "platform/input/text_file.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr std::size_t kLongestReason = 200;

// Where OpenCV 4 has the reason for a parsing error: in the place of the function's name, as "FILE(LINE):
// REASON".
std::string reason(const cv::Exception& error) {
  const std::size_t colon = error.func.rfind("): ");
  const std::size_t bracket = error.func.rfind('(', colon);
  if (error.code == cv::Error::StsParseError && colon != std::string::npos && bracket != std::string::npos) {
    return fmt::format("line {}: {}", error.func.substr(bracket + 1, colon - bracket - 1),
                       error.func.substr(colon + 3));
  }
  return error.err;
}

// OpenCV 4.6 leaves out what follows some parts of a text, and does not come back from others.
void check_yaml(const std::string& text, const std::string& path) {
  if (text.compare(0, 5, "%YAML") != 0) return;
  if (const std::string fault = look_at_opencv_yaml(text).fault; !fault.empty())
    throw UserError(fmt::format("{}: not an OpenCV YAML, XML or JSON file: {}", path, fault));
}

void check_begin(const std::string& text, const std::string& path) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) {
    throw UserError(fmt::format("{}: not an OpenCV YAML, XML or JSON file: it is empty", path));
  }
  if (text.find('\0') != std::string::npos)
    throw UserError(fmt::format("{}: not an OpenCV YAML, XML or JSON file: it holds a zero byte", path));
  const bool xml = text.compare(0, 5, "<?xml") == 0;
  // OpenCV 4.6 reads on behind the end of some XML texts.
  if (xml && text[text.find_last_not_of(" \t\r\n")] != '>') {
    throw UserError(fmt::format("{}: not an OpenCV YAML, XML or JSON file: it ends too early", path));
  }
  if (text.compare(0, 5, "%YAML") == 0 || xml || text[begin] == '{') return;
  throw UserError(fmt::format(
      "{}: not an OpenCV YAML, XML or JSON file: the first line of OpenCV's YAML is %YAML:1.0, XML begins "
      "with <?xml, JSON with {{",
      path));
}

}  // namespace

cv::FileStorage parse_file_storage(const std::string& text, const std::string& path) {
  check_begin(text, path);
  check_nesting(text, path);
  check_yaml(text, path);
  try {
    cv::FileStorage file(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    if (file.isOpened() && file.root().isMap()) {
      std::set<std::string> names;
      for (const cv::FileNode& entry : file.root()) {
        if (!names.insert(entry.name()).second) {
          throw UserError(fmt::format("{}: {} occurs twice", path, excerpt(entry.name())));
        }
      }
      return file;
    }
  } catch (const cv::Exception& error) {
    throw UserError(fmt::format("{}: not an OpenCV YAML, XML or JSON file: {}", path,
                                excerpt(reason(error), kLongestReason)));
  } catch (const std::logic_error&) {  // of OpenCV 4.6, std::length_error
    throw UserError(fmt::format("{}: not an OpenCV YAML, XML or JSON file: an entry has no name", path));
  }
  throw UserError(fmt::format("{}: not an OpenCV YAML, XML or JSON file: it has no named entries", path));
}

cv::FileStorage open_file_storage(const std::string& path) {
  return parse_file_storage(read_text_file(path), path);
}

}  // namespace parallax
