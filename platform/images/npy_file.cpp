// SPDX-License-Identifier: Apache-2.0
#include "platform/images/npy_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <regex>

#include "platform/images/sample_bytes.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr std::uint8_t kMagic[] = {0x93, 'N', 'U', 'M', 'P', 'Y'};
constexpr std::size_t kVersionAt = 6;
constexpr int kLargestSide = 1 << 20;  // px, a side

// What the header says.
struct ArrayLayout {
  std::string type;  // "f4", without the byte order
  bool big_endian = false;
  bool fortran = false;
  std::vector<int> shape;
  std::string shape_text;
  std::size_t begin = 0;  // of the values
};

ArrayLayout layout_of(const std::vector<std::uint8_t>& bytes, const std::string& name) {
  const auto damaged = [&](const std::string& why) {
    return UserError(fmt::format("{}: a NumPy array with a damaged header: {}", name, why));
  };
  if (bytes.size() < kVersionAt + 6) throw damaged("it ends there");
  const int version = bytes[kVersionAt];
  if (version < 1 || version > 3)
    throw UserError(fmt::format("{}: a NumPy array of format version {}, expected 1, 2 or 3", name, version));
  const std::size_t length_at = kVersionAt + 2;
  const std::size_t length = version == 1 ? number_of_bytes<std::uint16_t>(bytes.data() + length_at, false)
                                          : number_of_bytes<std::uint32_t>(bytes.data() + length_at, false);
  ArrayLayout layout;
  layout.begin = length_at + (version == 1 ? 2 : 4) + length;
  constexpr std::size_t kLongest = 1 << 12;
  if (layout.begin > bytes.size() || length > kLongest) throw damaged("it ends there");
  const std::string header(reinterpret_cast<const char*>(bytes.data()) + layout.begin - length, length);
  static const std::regex type("['\"]descr['\"]\\s*:\\s*['\"]([<>=|]?)([a-zA-Z?][0-9]*)['\"]");
  static const std::regex order("['\"]fortran_order['\"]\\s*:\\s*(True|False)");
  static const std::regex shape("['\"]shape['\"]\\s*:\\s*\\(([0-9, ]*)\\)");
  std::smatch match;
  if (!std::regex_search(header, match, type)) throw damaged("no simple type in 'descr'");
  layout.big_endian = match[1] == ">";
  layout.type = match[2];
  if (!std::regex_search(header, match, order)) throw damaged("no 'fortran_order'");
  layout.fortran = match[1] == "True";
  if (!std::regex_search(header, match, shape)) throw damaged("no 'shape'");
  layout.shape_text = "(" + match[1].str() + ")";
  const std::string sides = match[1];
  static const std::regex number("[0-9]+");
  for (std::sregex_iterator it(sides.begin(), sides.end(), number), end; it != end; ++it) {
    constexpr int kMostDigits = 7;
    const int side = it->length() <= kMostDigits ? std::stoi(it->str()) : 0;
    layout.shape.push_back(side <= kLargestSide ? side : 0);
  }
  return layout;
}

cv::Size size_of_shape(const ArrayLayout& layout, const std::string& name) {
  std::vector<int> shape = layout.shape;
  if (shape.size() == 3 && shape.back() == 1) shape.pop_back();
  if (shape.size() == 3 && shape.front() == 1) shape.erase(shape.begin());
  if (shape.size() != 2 || shape[0] == 0 || shape[1] == 0) {
    throw UserError(fmt::format("{}: a NumPy array of the shape {}, expected (rows, columns)", name,
                                excerpt(layout.shape_text)));
  }
  return {shape[1], shape[0]};
}

template <class From, class To>
cv::Mat values(const std::vector<std::uint8_t>& bytes, const ArrayLayout& layout, const cv::Size& size,
               const std::string& name) {
  const std::size_t wanted =
      sizeof(From) * static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  if (bytes.size() - layout.begin != wanted) {
    throw UserError(fmt::format("{}: {} bytes of values, but {} pixels of {} bytes are {}", name,
                                bytes.size() - layout.begin, size_text(size), sizeof(From), wanted));
  }
  cv::Mat_<To> image(size);
  const std::uint8_t* at = bytes.data() + layout.begin;
  const int outer = layout.fortran ? size.width : size.height;
  const int inner = layout.fortran ? size.height : size.width;
  for (int i = 0; i < outer; ++i) {
    for (int j = 0; j < inner; ++j, at += sizeof(From)) {
      To& pixel = layout.fortran ? image(j, i) : image(i, j);
      pixel = static_cast<To>(number_of_bytes<From>(at, layout.big_endian));
    }
  }
  return image;
}

}  // namespace

bool is_npy(const std::vector<std::uint8_t>& bytes) {
  return bytes.size() > std::size(kMagic) && std::equal(std::begin(kMagic), std::end(kMagic), bytes.begin());
}

cv::Mat read_npy(const std::vector<std::uint8_t>& bytes, const std::string& name, const SizeCheck& check) {
  const ArrayLayout layout = layout_of(bytes, name);
  using Read =
      cv::Mat (*)(const std::vector<std::uint8_t>&, const ArrayLayout&, const cv::Size&, const std::string&);
  static const std::pair<const char*, Read> types[] = {{"f2", values<cv::float16_t, float>},
                                                       {"f4", values<float, float>},
                                                       {"f8", values<double, double>},
                                                       {"u1", values<std::uint8_t, std::uint8_t>},
                                                       {"u2", values<std::uint16_t, std::uint16_t>},
                                                       {"u4", values<std::uint32_t, double>},
                                                       {"u8", values<std::uint64_t, double>},
                                                       {"i1", values<std::int8_t, double>},
                                                       {"i2", values<std::int16_t, double>},
                                                       {"i4", values<std::int32_t, double>},
                                                       {"i8", values<std::int64_t, double>}};
  const auto* const found = std::find_if(std::begin(types), std::end(types),
                                         [&](const auto& type) { return layout.type == type.first; });
  if (found == std::end(types)) {
    throw UserError(
        fmt::format("{}: a NumPy array of the type '{}', expected floating point of 16 to 64 bits or "
                    "integers of 8 to 64 bits",
                    name, excerpt(layout.type)));
  }
  const cv::Size size = size_of_shape(layout, name);
  check(size);
  return found->second(bytes, layout, size, name);
}

}  // namespace parallax
