// SPDX-License-Identifier: Apache-2.0
#include "platform/images/pfm_file.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <opencv2/core.hpp>

#include "platform/images/sample_bytes.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr int kLargestMapSide = 1 << 20;  // px, a side
constexpr std::size_t kSample = sizeof(float);

bool is_pfm_blank(std::uint8_t c) { return std::isspace(c) != 0; }

// The words of the header, one after the other.
class PfmHeader {
 public:
  explicit PfmHeader(const std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}

  std::string next() {
    constexpr std::size_t kLongest = 64;
    while (at_ < bytes_.size() && (is_pfm_blank(bytes_[at_]) || bytes_[at_] == '#')) {
      const bool comment = bytes_[at_] == '#';
      do ++at_;
      while (comment && at_ < bytes_.size() && bytes_[at_] != '\n');
    }
    std::string word;
    for (; at_ < bytes_.size() && !is_pfm_blank(bytes_[at_]) && word.size() < kLongest; ++at_)
      word += static_cast<char>(bytes_[at_]);
    return word;
  }
  /// Behind the last word.
  std::size_t end() const { return at_; }

 private:
  const std::vector<std::uint8_t>& bytes_;
  std::size_t at_ = 2;  // behind Pf
};

int map_side(const std::string& word) {
  constexpr std::size_t kMostDigits = 7;
  const bool digits = !word.empty() && word.find_first_not_of("0123456789") == std::string::npos;
  const int value = digits && word.size() <= kMostDigits ? std::stoi(word) : 0;
  return value <= kLargestMapSide ? value : 0;
}

double header_scale(const std::string& word) {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  return word.empty() || *end != '\0' || !std::isfinite(value) ? 0 : value;
}

}  // namespace

bool is_pfm(const std::vector<std::uint8_t>& bytes) {
  return bytes.size() > 2 && bytes[0] == 'P' && (bytes[1] == 'f' || bytes[1] == 'F') &&
         is_pfm_blank(bytes[2]);
}

PfmImage read_pfm(const std::vector<std::uint8_t>& bytes, const std::string& name, const SizeCheck& check) {
  if (bytes[1] == 'F') {
    throw UserError(
        fmt::format("{}: a colour map (PF), expected one channel (Pf): disparities have no colour", name));
  }
  PfmHeader header(bytes);
  const std::string width = header.next(), height = header.next(), scale = header.next();
  const cv::Size size(map_side(width), map_side(height));
  const double signed_scale = header_scale(scale);
  if (size.width == 0 || size.height == 0 || signed_scale == 0) {
    throw UserError(fmt::format(
        "{}: a damaged header: width '{}', height '{}', scale '{}'; expected two numbers of pixels and a "
        "number whose sign is the byte order",
        name, excerpt(width), excerpt(height), excerpt(scale)));
  }
  check(size);
  const std::size_t wanted =
      kSample * static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  // One blank ends the header; where a line ends in two, both do.
  std::size_t begin = header.end() + 1;
  if (bytes.size() == begin + wanted + 1 && bytes[begin - 1] == '\r' && bytes[begin] == '\n') ++begin;
  const std::size_t found = bytes.size() - std::min(begin, bytes.size());
  if (found != wanted) {
    throw UserError(fmt::format("{}: {} bytes of values, but {} pixels of 4 bytes are {}", name, found,
                                size_text(size), wanted));
  }
  PfmImage image{cv::Mat(size, CV_32FC1), std::abs(signed_scale)};
  for (int row = 0; row < size.height; ++row) {
    auto* const out = image.values.ptr<float>(size.height - 1 - row);  // the file begins with the lowest row
    for (int x = 0; x < size.width; ++x) {
      out[x] = number_of_bytes<float>(bytes.data() + begin, signed_scale > 0);
      begin += kSample;
    }
  }
  return image;
}

}  // namespace parallax
