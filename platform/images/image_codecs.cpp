// SPDX-License-Identifier: Apache-2.0
#include "platform/images/image_codecs.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "platform/images/shared_library.hpp"

namespace parallax {
namespace {

// The build defines PARALLAX_IMAGE_CODECS, such as "libopencv_imgcodecs.so.406".
const SharedLibrary& codecs() {
  static const SharedLibrary library(PARALLAX_IMAGE_CODECS);
  return library;
}

}  // namespace

cv::Mat read_image(const std::string& path, int flags) {
  using Function = cv::Mat(const cv::String&, int);
  static const auto imread =
      codecs().function<Function>("_ZN2cv6imreadERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEEi");
  return imread(path, flags);
}

cv::Mat decode_image(const std::vector<std::uint8_t>& bytes) {
  using Function = cv::Mat(cv::InputArray, int);
  static const auto imdecode = codecs().function<Function>("_ZN2cv8imdecodeERKNS_11_InputArrayEi");
  return imdecode(bytes, cv::IMREAD_UNCHANGED);
}

std::vector<std::uint8_t> encode_image(const std::string& extension, const cv::Mat& image) {
  using Function =
      bool(const cv::String&, cv::InputArray, std::vector<std::uint8_t>&, const std::vector<int>&);
  static const auto imencode = codecs().function<Function>(
      "_ZN2cv8imencodeERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEERKNS_11_"
      "InputArrayERSt6vectorIhSaIhEE"
      "RKSB_IiSaIiEE");
  std::vector<std::uint8_t> bytes;
  if (!imencode(extension, image, bytes, {}))
    throw std::runtime_error(fmt::format("{} encoder failed", extension));
  return bytes;
}

}  // namespace parallax
