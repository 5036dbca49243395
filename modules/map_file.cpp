// SPDX-License-Identifier: Apache-2.0
#include "modules/map_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "modules/map_decoder.hpp"
#include "tlm/error.hpp"

namespace parallax {

namespace {

constexpr std::array<std::uint8_t, 4> kMagic = {'P', 'L', 'X', 'M'};
constexpr std::uint32_t kVersion = 1;
constexpr std::uint32_t kLargestSide = 65535;

// Positions in the file, bytes.
constexpr std::size_t kChecksumAt = 4;
constexpr std::size_t kVersionAt = 8;
constexpr std::size_t kFractionBitsAt = 10;
constexpr std::size_t kBlockPixelsAt = 11;
constexpr std::size_t kWindowAt = 12;
constexpr std::size_t kReservedAt = 14;
constexpr std::size_t kWidthAt = 16;
constexpr std::size_t kHeightAt = 20;
constexpr std::size_t kTotalAt = 24;
constexpr std::size_t kHeaderBytes = 32;
constexpr std::size_t kRowLengthBytes = 4;

// CRC-32 of IEEE 802.3 (as in zlib and PNG): polynomial 0x04C11DB7 reflected, start and final inversion.
std::uint32_t crc32(const std::uint8_t* bytes, std::size_t size) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> t{};
    for (std::uint32_t i = 0; i < t.size(); ++i) {
      t[i] = i;
      for (int bit = 0; bit < 8; ++bit) {
        t[i] = (t[i] >> 1) ^ ((t[i] & 1U) != 0 ? 0xEDB88320U : 0U);
      }
    }
    return t;
  }();
  std::uint32_t crc = 0xFFFFFFFFU;
  for (std::size_t i = 0; i < size; ++i) {
    crc = (crc >> 8) ^ table[(crc ^ bytes[i]) & 0xFFU];
  }
  return ~crc;
}

void put(std::vector<std::uint8_t>& bytes, std::size_t at, std::uint64_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    bytes[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
  }
}

std::uint64_t get(const std::vector<std::uint8_t>& bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value |= std::uint64_t{bytes[at + i]} << (8 * i);
  }
  return value;
}

[[noreturn]] void fail(const std::string& name, const std::string& what) {
  throw UserError(fmt::format("{}: {}", name, what));
}

void check_identity(const std::vector<std::uint8_t>& bytes, const std::string& name) {
  if (bytes.size() < kMagic.size() || !std::equal(kMagic.begin(), kMagic.end(), bytes.begin())) {
    fail(name, "not a rectification map: the first four bytes are not PLXM");
  }
  if (bytes.size() < kHeaderBytes) {
    fail(name, fmt::format("truncated rectification map: {} bytes, the header alone has {}", bytes.size(),
                           kHeaderBytes));
  }
  const std::uint64_t version = get(bytes, kVersionAt, 2);
  if (version != kVersion) {
    fail(name, fmt::format("rectification map of version {} (byte {}); this program reads version {}",
                           version, kVersionAt, kVersion));
  }
  const std::uint64_t total = get(bytes, kTotalAt, 8);
  if (bytes.size() < total) {
    fail(name, fmt::format("truncated rectification map: it ends at byte {} of {}", bytes.size(), total));
  }
  if (bytes.size() > total) {
    fail(name, fmt::format("corrupt rectification map: {} bytes follow its end at byte {}",
                           bytes.size() - total, total));
  }
  const auto stated = static_cast<std::uint32_t>(get(bytes, kChecksumAt, 4));
  const std::uint32_t computed = crc32(bytes.data() + kVersionAt, bytes.size() - kVersionAt);
  if (stated != computed) {
    fail(name,
         fmt::format("corrupt rectification map: checksum {:08x} of bytes {}..{}, stated {:08x} at byte {}",
                     computed, kVersionAt, bytes.size() - 1, stated, kChecksumAt));
  }
}

// What a file with a matching checksum can still have wrong: another writer's mistakes.
void check_fields(const std::vector<std::uint8_t>& bytes, const std::string& name) {
  const auto require = [&](bool good, std::size_t at, const char* what) {
    if (!good) {
      fail(name, fmt::format("malformed rectification map: {} at byte {}", what, at));
    }
  };
  const std::uint64_t width = get(bytes, kWidthAt, 4);
  const std::uint64_t height = get(bytes, kHeightAt, 4);
  require(get(bytes, kBlockPixelsAt, 1) == map_code::kBlockPixels, kBlockPixelsAt, "unknown block length");
  require(get(bytes, kReservedAt, 2) == 0, kReservedAt, "reserved bytes are not zero");
  require(width >= 1 && width <= kLargestSide, kWidthAt, "width outside 1..65535");
  require(height >= 1 && height <= kLargestSide, kHeightAt, "height outside 1..65535");
  require(width * height <= kMostMapPixels, kWidthAt, "more than 67108864 pixels");
  require(bytes.size() >= kHeaderBytes + height * kRowLengthBytes, kHeightAt,
          "more rows than the file can hold");
}

}  // namespace

std::vector<std::uint8_t> to_file_bytes(const EncodedMap& map) {
  const std::size_t table = map.row_bytes.size() * kRowLengthBytes;
  std::vector<std::uint8_t> bytes(kHeaderBytes + table + map.bytes.size());
  std::copy(kMagic.begin(), kMagic.end(), bytes.begin());
  put(bytes, kVersionAt, kVersion, 2);
  put(bytes, kFractionBitsAt, map.range.fraction_bits, 1);
  put(bytes, kBlockPixelsAt, map_code::kBlockPixels, 1);
  put(bytes, kWindowAt, map.range.window, 2);
  put(bytes, kWidthAt, map.width, 4);
  put(bytes, kHeightAt, map.height, 4);
  put(bytes, kTotalAt, bytes.size(), 8);
  for (std::size_t y = 0; y < map.row_bytes.size(); ++y) {
    put(bytes, kHeaderBytes + y * kRowLengthBytes, map.row_bytes[y], kRowLengthBytes);
  }
  std::copy(map.bytes.begin(), map.bytes.end(), bytes.begin() + kHeaderBytes + table);
  put(bytes, kChecksumAt, crc32(bytes.data() + kVersionAt, bytes.size() - kVersionAt), 4);
  return bytes;
}

EncodedMap from_file_bytes(const std::vector<std::uint8_t>& bytes, const std::string& name) {
  check_identity(bytes, name);
  check_fields(bytes, name);
  EncodedMap map;
  const auto number = [&](std::size_t at, std::size_t size) {
    return static_cast<int>(get(bytes, at, size));
  };
  map.width = number(kWidthAt, 4);
  map.height = number(kHeightAt, 4);
  map.range.window = number(kWindowAt, 2);
  map.range.fraction_bits = number(kFractionBitsAt, 1);
  try {
    map.range.validate();
  } catch (const UserError& error) {
    fail(name, error.what());
  }
  std::uint64_t sum = 0;
  for (int y = 0; y < map.height; ++y) {
    const std::size_t at = kHeaderBytes + y * kRowLengthBytes;
    const std::uint64_t row = get(bytes, at, kRowLengthBytes);
    const std::size_t least = least_row_bytes(map.width);
    const std::size_t most = worst_row_bytes(map.width, map.range);
    if (row < least || row > most) {
      fail(name, fmt::format("malformed rectification map: row {} of {} bytes at byte {}, a row has {}..{}",
                             y, row, at, least, most));
    }
    map.row_bytes.push_back(static_cast<std::uint32_t>(row));
    sum += row;
  }
  const std::size_t rows_at = kHeaderBytes + map.row_bytes.size() * kRowLengthBytes;
  if (rows_at + sum != bytes.size()) {
    fail(name, fmt::format("malformed rectification map: its rows end at byte {} of {}", rows_at + sum,
                           bytes.size()));
  }
  map.bytes.assign(bytes.begin() + rows_at, bytes.end());
  return map;
}

}  // namespace parallax
