// SPDX-License-Identifier: Apache-2.0
#include "modules/map_decoder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

#include "modules/area.hpp"
#include "tlm/error.hpp"

namespace parallax {

using namespace map_code;

namespace {

constexpr std::size_t kPadding = sizeof(std::uint64_t);

std::uint64_t fetch(const std::uint8_t* bytes, std::size_t bit) {
  std::uint64_t word = 0;
  std::memcpy(&word, bytes + bit / 8, sizeof word);
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
  word = __builtin_bswap64(word);
#endif
  return word >> (bit % 8);
}

// The lowest `bits` bits as a two's complement number; 0 for no bits.
std::int32_t sign_extend(std::uint32_t value, int bits) {
  if (bits == 0) {
    return 0;
  }
  const int unused = 32 - bits;
  return static_cast<std::int32_t>(value << unused) >> unused;
}

struct Widths {
  int dx;
  int dy;
};

class ImageState {
 public:
  explicit ImageState(int offset_bits) : offset_bits_(offset_bits) {}

  // `up` is the value above; the prediction is left + (up - upleft).
  Offset next(const Offset& up, std::int32_t dx, std::int32_t dy) {
    left_dx_ = wrap(left_dx_ + up.dx - upleft_.dx + dx);
    left_dy_ = wrap(left_dy_ + up.dy - upleft_.dy + dy);
    upleft_ = up;
    return {static_cast<std::int16_t>(left_dx_), static_cast<std::int16_t>(left_dy_)};
  }

 private:
  std::int32_t wrap(std::int32_t value) const { return sign_extend(value, offset_bits_); }

  int offset_bits_;
  std::int32_t left_dx_ = 0;
  std::int32_t left_dy_ = 0;
  Offset upleft_;
};

Offset take(const std::uint8_t* bytes, std::size_t& bit, const Widths& width, const Offset& up,
            ImageState& state) {
  const std::uint64_t word = fetch(bytes, bit);
  const std::int32_t dx = sign_extend(static_cast<std::uint32_t>(word), width.dx);
  const std::int32_t dy = sign_extend(static_cast<std::uint32_t>(word >> width.dx), width.dy);
  bit += width.dx + width.dy;
  return state.next(up, dx, dy);
}

const OffsetRange& validated(const OffsetRange& range) {
  range.validate();
  return range;
}

[[noreturn]] void fail(const char* what, int row, int x, std::size_t bit) {
  throw UserError(
      fmt::format("rectification map: row {}, pixel {} (byte {} of the row): {}", row, x, bit / 8, what));
}

// The block of pixels from `begin` to `end` of a row of `size` bytes, whose code begins at `bit`.
struct Block {
  std::array<int, kComponents> widths{};
  int pair_bits = 0;  // of a pixel's code

  Block(std::uint64_t header, const OffsetRange& range, int row, int begin, std::size_t bit) {
    for (std::size_t i = 0; i < widths.size(); ++i) {
      widths[i] = (header >> (i * kWidthFieldBits)) & ((1U << kWidthFieldBits) - 1U);
      if (widths[i] > range.offset_bits()) fail("a residual is wider than an offset", row, begin, bit);
      pair_bits += widths[i];
    }
  }
};

// Calls per_block(block, begin, end, bit) for the blocks of a row, `bit` being that of the first pixel's
// code. The header at a bit is header(bit), of which the lowest bits are looked at. Returns the bit after the
// last block.
template <class Header, class PerBlock>
std::size_t for_each_block(std::size_t size, int width, const OffsetRange& range, int row,
                           const Header& header, const PerBlock& per_block) {
  std::size_t bit = 0;
  for (int begin = 0; begin < width; begin += kBlockPixels) {
    if (bit + kHeaderBits > size * 8) fail("the row ends before the block's header", row, begin, bit);
    const Block block(header(bit), range, row, begin, bit);
    bit += kHeaderBits;
    const int end = std::min(begin + kBlockPixels, width);
    const std::size_t after = bit + static_cast<std::size_t>(end - begin) * block.pair_bits;
    if (after > size * 8) fail("the row ends within the block", row, begin, bit);
    per_block(block, begin, end, bit);
    bit = after;
  }
  return bit;
}

std::size_t blocks(int width) { return (width + kBlockPixels - 1) / kBlockPixels; }

}  // namespace

std::size_t least_row_bytes(int width) { return blocks(width) * kHeaderBits / 8; }

std::size_t worst_row_bytes(int width, const OffsetRange& range) {
  const std::size_t residuals = area(width, kComponents);
  return (blocks(width) * kHeaderBits + residuals * range.offset_bits() + 7) / 8;
}

MapDecoder::MapDecoder(const OffsetRange& range, int width, int height)
    : range_(validated(range)),
      offset_bits_(range_.offset_bits()),
      width_(width),
      height_(height),
      previous_(width),
      bytes_(worst_row_bytes(width, range_) + kPadding) {}

std::int64_t MapDecoder::storage_bits() const { return std::int64_t{width_} * kComponents * offset_bits_; }

void map_code_ends(const std::uint8_t* bytes, std::size_t size, const OffsetRange& range, int row,
                   std::vector<std::uint32_t>& end_bit) {
  // A header lies in up to three bytes, and no byte after them is there for sure.
  const auto header = [&](std::size_t bit) {
    std::uint32_t word = 0;
    for (std::size_t byte = bit / 8, i = 0; i < 3 && byte + i < size; ++i) word |= bytes[byte + i] << (8 * i);
    return std::uint64_t{word >> (bit % 8)};
  };
  for_each_block(size, static_cast<int>(end_bit.size()), range, row, header,
                 [&](const Block& block, int begin, int end, std::size_t bit) {
                   for (int x = begin; x < end; ++x)
                     end_bit[x] = static_cast<std::uint32_t>(bit += block.pair_bits);
                 });
}

std::size_t MapDecoder::push(const std::uint8_t* bytes, std::size_t size, OffsetPair* out) {
  const std::size_t usable = std::min(size, bytes_.size() - kPadding);
  std::copy_n(bytes, usable, bytes_.begin());
  std::size_t used = 0;
  try {
    used = decode(usable, out);
    check_range(out);
  } catch (const UserError&) {
    y_ = 0;
    std::fill(previous_.begin(), previous_.end(), OffsetPair{});
    throw;
  }
  if (++y_ == height_) {
    y_ = 0;
    std::fill(previous_.begin(), previous_.end(), OffsetPair{});
  } else {
    std::copy_n(out, width_, previous_.begin());
  }
  return used;
}

std::size_t MapDecoder::decode(std::size_t size, OffsetPair* out) const {
  ImageState left(offset_bits_);
  ImageState right(offset_bits_);
  const std::size_t bit = for_each_block(
      size, width_, range_, y_, [this](std::size_t at) { return fetch(bytes_.data(), at); },
      [&](const Block& block, int begin, int end, std::size_t at) {
        for (int x = begin; x < end; ++x) {
          const OffsetPair& up = previous_[x];
          out[x].left = take(bytes_.data(), at, {block.widths[0], block.widths[1]}, up.left, left);
          out[x].right = take(bytes_.data(), at, {block.widths[2], block.widths[3]}, up.right, right);
        }
      });
  const std::size_t padding = (8 - bit % 8) % 8;
  if ((fetch(bytes_.data(), bit) & ((1U << padding) - 1U)) != 0) {
    fail("the bits that fill the last byte are not zero", y_, width_ - 1, bit);
  }
  return (bit + padding) / 8;
}

void MapDecoder::check_range(const OffsetPair* row) const {
  const int limit = range_.limit();
  const auto beyond = [limit](const Offset& o) { return std::abs(o.dx) > limit || std::abs(o.dy) > limit; };
  int largest = 0;
  for (int x = 0; x < width_; ++x) {
    for (const Offset& o : {row[x].left, row[x].right})
      largest = std::max({largest, std::abs(o.dx), std::abs(o.dy)});
  }
  if (largest <= limit) return;
  for (int x = 0; x < width_; ++x) {
    if (beyond(row[x].left) || beyond(row[x].right)) {
      throw UserError(
          fmt::format("rectification map: row {}, pixel {}: an offset is beyond the window of {} px", y_, x,
                      range_.window));
    }
  }
}

}  // namespace parallax
