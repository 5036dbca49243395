// SPDX-License-Identifier: Apache-2.0
#include "platform/images/image_header.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <limits>
#include <sstream>

namespace parallax {
namespace {

struct HeaderSize {
  std::uint64_t width = 0;
  std::uint64_t height = 0;
};

// Numbers at places of a file. What lies beyond its end is 0, which no format takes for a size.
class FileBytes {
 public:
  explicit FileBytes(const std::string& path) : file_(path, std::ios::binary) {}

  std::string text(std::uint64_t at, std::size_t count) {
    std::string read(count, '\0');
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(at));
    file_.read(read.data(), static_cast<std::streamsize>(count));
    read.resize(file_.gcount() < 0 ? 0 : static_cast<std::size_t>(file_.gcount()));
    return read;
  }
  std::uint64_t big(std::uint64_t at, int count) { return number(at, count, true); }
  std::uint64_t little(std::uint64_t at, int count) { return number(at, count, false); }
  std::uint64_t number(std::uint64_t at, int count, bool big_endian) {
    std::string read = text(at, static_cast<std::size_t>(count));
    read.resize(static_cast<std::size_t>(count));
    std::uint64_t value = 0;
    for (int i = 0; i < count; ++i) {
      const auto byte =
          static_cast<unsigned char>(read[static_cast<std::size_t>(big_endian ? i : count - 1 - i)]);
      value = value << 8 | byte;
    }
    return value;
  }

 private:
  std::ifstream file_;
};

HeaderSize png(FileBytes& bytes) { return {bytes.big(16, 4), bytes.big(20, 4)}; }

HeaderSize bmp(FileBytes& bytes) {
  constexpr std::uint64_t kOldHeader = 12;
  if (bytes.little(14, 4) == kOldHeader) return {bytes.little(18, 2), bytes.little(20, 2)};
  const auto height = static_cast<std::int32_t>(bytes.little(22, 4));  // negative: rows from the top
  return {bytes.little(18, 4), static_cast<std::uint64_t>(height < 0 ? -std::int64_t{height} : height)};
}

HeaderSize jpeg(FileBytes& bytes) {
  constexpr int kMostSegments = 10000;
  std::uint64_t at = 2;
  for (int i = 0; i < kMostSegments; ++i) {
    if (bytes.big(at, 1) != 0xFF) return {};
    const std::uint64_t marker = bytes.big(at + 1, 1);
    if (marker == 0xFF) {  // filling
      ++at;
    } else if (marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC) {
      return {bytes.big(at + 7, 2), bytes.big(at + 5, 2)};
    } else if (marker == 0x01 || (marker >= 0xD0 && marker <= 0xD7)) {  // without a length
      at += 2;
    } else if (marker == 0xD9 || marker == 0xDA || marker == 0) {
      return {};
    } else {
      at += 2 + bytes.big(at + 2, 2);
    }
  }
  return {};
}

HeaderSize tiff(FileBytes& bytes, bool big_endian, bool big_file) {
  constexpr std::uint64_t kWidth = 256, kHeight = 257, kMostEntries = 4096;
  constexpr std::uint64_t kShort = 3, kLong8 = 16;
  const auto number = [&](std::uint64_t at, int count) { return bytes.number(at, count, big_endian); };
  const std::uint64_t directory = big_file ? number(8, 8) : number(4, 4);
  const std::uint64_t entries = std::min(kMostEntries, number(directory, big_file ? 8 : 2));
  const std::uint64_t first = directory + (big_file ? 8 : 2);
  const std::uint64_t step = big_file ? 20 : 12;
  HeaderSize size;
  for (std::uint64_t i = 0; i < entries; ++i) {
    const std::uint64_t at = first + i * step;
    const std::uint64_t tag = number(at, 2);
    const std::uint64_t type = number(at + 2, 2);
    const std::uint64_t value = number(at + (big_file ? 12 : 8), type == kShort ? 2 : type == kLong8 ? 8 : 4);
    if (tag == kWidth) size.width = value;
    if (tag == kHeight) size.height = value;
  }
  return size;
}

// Words between blanks, comments from # to the end of the line left out.
class HeaderWords {
 public:
  explicit HeaderWords(const std::string& text) : in_(text) {}
  std::string next() {
    std::string word;
    for (int c = in_.get(); c != EOF; c = in_.get()) {
      if (c == '#') {
        std::string comment;
        std::getline(in_, comment);
        c = ' ';
      }
      if (std::isspace(c) == 0) {
        word += static_cast<char>(c);
      } else if (!word.empty()) {
        break;
      }
    }
    return word;
  }
  std::uint64_t number() {
    const std::string word = next();
    constexpr std::size_t kMostDigits = 10;
    const bool digits = word.find_first_not_of("0123456789") == std::string::npos;
    return digits && !word.empty() && word.size() <= kMostDigits ? std::stoull(word) : 0;
  }

 private:
  std::istringstream in_;
};

HeaderSize pnm(FileBytes& bytes) {
  constexpr std::size_t kLongestHeader = 1 << 16;
  HeaderWords words(bytes.text(2, kLongestHeader));
  const std::uint64_t width = words.number();
  return {width, words.number()};
}

HeaderSize pam(FileBytes& bytes) {
  constexpr std::size_t kLongestHeader = 1 << 16;
  HeaderWords words(bytes.text(2, kLongestHeader));
  HeaderSize size;
  for (std::string word = words.next(); !word.empty() && word != "ENDHDR"; word = words.next()) {
    if (word == "WIDTH") size.width = words.number();
    if (word == "HEIGHT") size.height = words.number();
  }
  return size;
}

HeaderSize webp(FileBytes& bytes) {
  const std::string kind = bytes.text(12, 4);
  constexpr std::uint64_t kFourteenBits = 0x3FFF;
  if (kind == "VP8 ") return {bytes.little(26, 2) & kFourteenBits, bytes.little(28, 2) & kFourteenBits};
  if (kind == "VP8X") return {bytes.little(24, 3) + 1, bytes.little(27, 3) + 1};
  if (kind != "VP8L") return {};
  const std::uint64_t packed = bytes.little(21, 4);
  return {(packed & kFourteenBits) + 1, (packed >> 14 & kFourteenBits) + 1};
}

HeaderSize header_size_of(FileBytes& bytes) {
  using namespace std::string_literals;
  const std::string head = bytes.text(0, 12);
  const auto begins = [&head](const std::string& with) { return head.rfind(with, 0) == 0; };
  if (begins("\x89PNG\r\n\x1A\n")) return png(bytes);
  if (begins("\xFF\xD8")) return jpeg(bytes);
  if (begins("II*\0"s) || begins("MM\0*"s)) return tiff(bytes, head[0] == 'M', false);
  if (begins("II+\0"s) || begins("MM\0+"s)) return tiff(bytes, head[0] == 'M', true);
  if (begins("BM")) return bmp(bytes);
  if (begins("RIFF") && head.size() == 12 && head.substr(8) == "WEBP") return webp(bytes);
  if (head.size() > 2 && head[0] == 'P' && std::isspace(static_cast<unsigned char>(head[2])) != 0) {
    if (head[1] >= '1' && head[1] <= '6') return pnm(bytes);
    if (head[1] == '7') return pam(bytes);
  }
  return {};
}

}  // namespace

std::optional<cv::Size> image_size_of_header(const std::string& path) {
  FileBytes bytes(path);
  const HeaderSize size = header_size_of(bytes);
  constexpr std::uint64_t kMost = std::numeric_limits<int>::max();
  if (size.width == 0 || size.height == 0 || size.width > kMost || size.height > kMost) return std::nullopt;
  return cv::Size(static_cast<int>(size.width), static_cast<int>(size.height));
}

}  // namespace parallax
