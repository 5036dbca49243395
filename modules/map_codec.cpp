// SPDX-License-Identifier: Apache-2.0
#include "modules/map_codec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>

#include "modules/map_decoder.hpp"
#include "tlm/error.hpp"

namespace parallax {

using namespace map_code;

namespace {

using Components = std::array<std::int32_t, kComponents>;

Components components(const OffsetPair& pair) {
  return {pair.left.dx, pair.left.dy, pair.right.dx, pair.right.dy};
}

// Bits of the two's complement number `value`; 0 for 0.
int bits_of(std::int32_t value) {
  int bits = 0;
  if (value != 0) {
    bits = 1;
    while (value < -(1 << (bits - 1)) || value >= (1 << (bits - 1))) {
      ++bits;
    }
  }
  return bits;
}

class BitWriter {
 public:
  explicit BitWriter(std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}

  void put(std::int32_t value, int bits) {
    const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    pending_ |= (static_cast<std::uint64_t>(static_cast<std::uint32_t>(value)) & mask) << count_;
    count_ += bits;
    for (; count_ >= 8; count_ -= 8, pending_ >>= 8) {
      bytes_.push_back(static_cast<std::uint8_t>(pending_));
    }
  }

  void fill_byte() {
    if (count_ > 0) {
      put(0, 8 - count_);
    }
  }

 private:
  std::vector<std::uint8_t>& bytes_;
  std::uint64_t pending_ = 0;
  int count_ = 0;
};

class RowEncoder {
 public:
  explicit RowEncoder(const RectificationMap& map) : map_(map), modulus_(1 << map.range.offset_bits()) {}

  void encode_row(int y, std::vector<std::uint8_t>& bytes) const {
    BitWriter writer(bytes);
    std::array<Components, kBlockPixels> residuals{};
    for (int begin = 0; begin < map_.width; begin += kBlockPixels) {
      const int count = std::min(kBlockPixels, map_.width - begin);
      std::array<int, kComponents> widths{};
      for (int i = 0; i < count; ++i) {
        Components& r = residuals[static_cast<std::size_t>(i)];
        r = residual(begin + i, y);
        for (std::size_t c = 0; c < r.size(); ++c) {
          widths[c] = std::max(widths[c], bits_of(r[c]));
        }
      }
      for (const int width : widths) {
        writer.put(width, kWidthFieldBits);
      }
      for (int i = 0; i < count; ++i) {
        for (std::size_t c = 0; c < widths.size(); ++c) {
          writer.put(residuals[static_cast<std::size_t>(i)][c], widths[c]);
        }
      }
    }
    writer.fill_byte();
  }

 private:
  Components value(int x, int y) const { return x < 0 || y < 0 ? Components{} : components(map_.row(y)[x]); }

  // value - (left + up - upleft), wrapped: missing neighbours count as zero, which gives the predictors of
  // the edges.
  Components residual(int x, int y) const {
    const Components here = value(x, y);
    const Components left = value(x - 1, y);
    const Components up = value(x, y - 1);
    const Components upleft = value(x - 1, y - 1);
    Components r{};
    for (std::size_t c = 0; c < r.size(); ++c) {
      const std::int32_t difference = here[c] - left[c] - up[c] + upleft[c];
      r[c] = ((difference + modulus_ / 2) & (modulus_ - 1)) - modulus_ / 2;
    }
    return r;
  }

  const RectificationMap& map_;
  std::int32_t modulus_;
};

void check(const RectificationMap& map) {
  map.range.validate();
  const std::size_t pixels = static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
  if (map.width < 1 || map.height < 1 || map.offsets.size() != pixels) {
    throw std::invalid_argument(
        fmt::format("map of {}x{} pixels with {} offsets", map.width, map.height, map.offsets.size()));
  }
  for (const OffsetPair& pair : map.offsets) {
    for (const std::int32_t value : components(pair)) {
      if (std::abs(value) > map.range.limit()) {
        throw std::invalid_argument(
            fmt::format("offset {} is beyond the map's limit {}", value, map.range.limit()));
      }
    }
  }
}

}  // namespace

double EncodedMap::bytes_per_pixel() const {
  return static_cast<double>(bytes.size()) / (2.0 * static_cast<double>(width) * static_cast<double>(height));
}

EncodedMap encode(const RectificationMap& map) {
  check(map);
  EncodedMap encoded{map.width, map.height, map.range, {}, {}};
  const RowEncoder encoder(map);
  for (int y = 0; y < map.height; ++y) {
    const std::size_t begin = encoded.bytes.size();
    encoder.encode_row(y, encoded.bytes);
    encoded.row_bytes.push_back(static_cast<std::uint32_t>(encoded.bytes.size() - begin));
  }
  return encoded;
}

RectificationMap decode(const EncodedMap& encoded) {
  RectificationMap map = identity_map(encoded.width, encoded.height, encoded.range);
  MapDecoder decoder(encoded.range, encoded.width, encoded.height);
  std::size_t begin = 0;
  for (int y = 0; y < encoded.height; ++y) {
    const std::size_t size = encoded.row_bytes.at(static_cast<std::size_t>(y));
    if (begin + size > encoded.bytes.size()) {
      throw UserError(fmt::format("rectification map: row {} ends at byte {} of {}", y, begin + size,
                                  encoded.bytes.size()));
    }
    OffsetPair* row = map.offsets.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width);
    const std::size_t used = decoder.push(encoded.bytes.data() + begin, size, row);
    if (used != size) {
      throw UserError(
          fmt::format("rectification map: row {} takes {} bytes, its stated length is {}", y, used, size));
    }
    begin += size;
  }
  if (begin != encoded.bytes.size()) {
    throw UserError(
        fmt::format("rectification map: the rows end at byte {} of {}", begin, encoded.bytes.size()));
  }
  return map;
}

}  // namespace parallax
