// SPDX-License-Identifier: Apache-2.0
#include "modules/map_codec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "modules/area.hpp"
#include "modules/map_decoder.hpp"
#include "tlm/error.hpp"

namespace parallax {

using namespace map_code;

namespace {

using Components = std::array<std::int32_t, kComponents>;

Components components(const OffsetPair& pair) {
  return {pair.left.dx, pair.left.dy, pair.right.dx, pair.right.dy};
}

// The width that a block needs for its residuals of one component.
class ResidualWidth {
 public:
  void add(std::int32_t value) {
    ones_ |= value;
    magnitudes_ |= static_cast<std::uint32_t>(value ^ (value >> 31));
  }
  // Of the widest as a two's complement number; 0 if all are 0.
  int bits() const {
    if (magnitudes_ == 0) return ones_ == 0 ? 0 : 1;  // -1 is the sign bit alone
    return 33 - __builtin_clz(magnitudes_);
  }

 private:
  std::int32_t ones_ = 0;
  std::uint32_t magnitudes_ = 0;
};

// Appends bits at `end`, which has room for them and for seven bytes more.
class BitWriter {
 public:
  explicit BitWriter(std::uint8_t* end) : end_(end) {}

  /// At most 32 bits.
  void put(std::int32_t value, int bits) {
    const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    pending_ |= (value & mask) << count_;
    count_ += bits;
    if (count_ < 32) return;
    store(4);
    pending_ >>= 32;
    count_ -= 32;
  }

  /// Fills the last byte with zeros; returns the first byte after it.
  std::uint8_t* finish() {
    store((count_ + 7) / 8);
    return end_;
  }

 private:
  void store(int bytes) {
    for (int i = 0; i < 4; ++i) end_[i] = static_cast<std::uint8_t>(pending_ >> (8 * i));
    end_ += bytes;
  }

  std::uint8_t* end_;
  std::uint64_t pending_ = 0;
  int count_ = 0;
};

// The code of one row; `above` is the row before it, zeros for the first one.
class RowEncoder {
 public:
  RowEncoder(int width, const OffsetRange& range, const OffsetPair* above, const OffsetPair* row)
      : width_(width),
        worst_(worst_row_bytes(width, range)),
        modulus_(1 << range.offset_bits()),
        above_(above),
        row_(row) {}

  void encode(std::vector<std::uint8_t>& bytes) {
    const std::size_t size = bytes.size();
    bytes.resize(size + worst_ + kRoom);
    BitWriter writer(bytes.data() + size);
    std::array<Components, kBlockPixels> residuals{};
    for (int begin = 0; begin < width_; begin += kBlockPixels) {
      const int count = std::min(kBlockPixels, width_ - begin);
      std::array<ResidualWidth, kComponents> needed{};
      for (int i = 0; i < count; ++i) {
        Components& r = residuals[i];
        r = residual(begin + i);
        for (std::size_t c = 0; c < r.size(); ++c) needed[c].add(r[c]);
      }
      std::array<int, kComponents> widths{};
      for (std::size_t c = 0; c < widths.size(); ++c) {
        widths[c] = needed[c].bits();
        writer.put(widths[c], kWidthFieldBits);
      }
      for (int i = 0; i < count; ++i) {
        for (std::size_t c = 0; c < widths.size(); ++c) {
          writer.put(residuals[i][c], widths[c]);
        }
      }
    }
    bytes.resize(writer.finish() - bytes.data());
  }

 private:
  static constexpr std::size_t kRoom = 8;  // bytes, for BitWriter

  // value - (left + up - upleft), wrapped: missing neighbours count as zero, which gives the predictors of
  // the edges. To be asked for every x in turn.
  Components residual(int x) {
    const Components here = components(row_[x]);
    const Components up = components(above_[x]);
    Components r{};
    for (std::size_t c = 0; c < r.size(); ++c) {
      const std::int32_t step = here[c] - up[c];
      const std::int32_t difference = step - left_step_[c];
      r[c] = ((difference + modulus_ / 2) & (modulus_ - 1)) - modulus_ / 2;
      left_step_[c] = step;
    }
    return r;
  }

  int width_;
  std::size_t worst_;
  std::int32_t modulus_;
  const OffsetPair* above_;
  const OffsetPair* row_;
  Components left_step_{};  // value - up, of the pixel before
};

}  // namespace

double EncodedMap::bytes_per_pixel() const {
  return static_cast<double>(bytes.size()) / (2.0 * width * height);
}

MapEncoder::MapEncoder(int width, int height, const OffsetRange& range)
    : map_{width, height, range, {}, {}}, previous_(std::max(width, 0)) {
  range.validate();
  if (width < 1 || height < 1) {
    throw std::invalid_argument(fmt::format("map of {}x{} pixels", width, height));
  }
}

void MapEncoder::push(const OffsetPair* row) {
  const int limit = map_.range.limit();
  std::int32_t largest = 0;
  for (int x = 0; x < map_.width; ++x) {
    for (const std::int32_t value : components(row[x])) largest = std::max(largest, std::abs(value));
  }
  for (int x = 0; largest > limit && x < map_.width; ++x) {
    for (const std::int32_t value : components(row[x])) {
      if (std::abs(value) > limit) {
        throw std::invalid_argument(fmt::format("offset {} is beyond the map's limit {}", value, limit));
      }
    }
  }
  if (map_.row_bytes.empty()) first_.assign(row, row + map_.width);
  const std::size_t begin = map_.bytes.size();
  RowEncoder(map_.width, map_.range, previous_.data(), row).encode(map_.bytes);
  map_.row_bytes.push_back(static_cast<std::uint32_t>(map_.bytes.size() - begin));
  std::copy_n(row, map_.width, previous_.begin());
}

// A row's code depends on the row above: below a row of ours, that of the first one is another.
void MapEncoder::append(const MapEncoder& below) {
  push(below.first_.data());
  const EncodedMap& rows = below.map_;
  map_.bytes.insert(map_.bytes.end(), rows.bytes.begin() + rows.row_bytes.front(), rows.bytes.end());
  map_.row_bytes.insert(map_.row_bytes.end(), rows.row_bytes.begin() + 1, rows.row_bytes.end());
  previous_ = below.previous_;
}

EncodedMap MapEncoder::take() {
  if (map_.row_bytes.size() != static_cast<std::size_t>(map_.height)) {
    throw std::logic_error(
        fmt::format("a map of {} rows is taken after {}", map_.height, map_.row_bytes.size()));
  }
  map_.bytes.shrink_to_fit();
  return std::move(map_);
}

EncodedMap encode(const RectificationMap& map) {
  MapEncoder encoder(map.width, map.height, map.range);
  if (map.offsets.size() != area(map.width, map.height)) {
    throw std::invalid_argument(
        fmt::format("map of {}x{} pixels with {} offsets", map.width, map.height, map.offsets.size()));
  }
  for (int y = 0; y < map.height; ++y) encoder.push(map.row(y));
  return encoder.take();
}

void decode_rows(const EncodedMap& encoded, const RowSink<OffsetPair>& emit) {
  MapDecoder decoder(encoded.range, encoded.width, encoded.height);
  std::vector<OffsetPair> row(encoded.width);
  std::size_t begin = 0;
  for (int y = 0; y < encoded.height; ++y) {
    const std::size_t size = encoded.row_bytes.at(y);
    if (begin + size > encoded.bytes.size()) {
      throw UserError(fmt::format("rectification map: row {} ends at byte {} of {}", y, begin + size,
                                  encoded.bytes.size()));
    }
    const std::size_t used = decoder.push(encoded.bytes.data() + begin, size, row.data());
    if (used != size) {
      throw UserError(
          fmt::format("rectification map: row {} takes {} bytes, its stated length is {}", y, used, size));
    }
    emit(row.data());
    begin += size;
  }
  if (begin != encoded.bytes.size()) {
    throw UserError(
        fmt::format("rectification map: the rows end at byte {} of {}", begin, encoded.bytes.size()));
  }
}

RectificationMap decode(const EncodedMap& encoded) {
  RectificationMap map = identity_map(encoded.width, encoded.height, encoded.range);
  OffsetPair* next = map.offsets.data();
  decode_rows(encoded, [&](const OffsetPair* row) { next = std::copy_n(row, map.width, next); });
  return map;
}

}  // namespace parallax
