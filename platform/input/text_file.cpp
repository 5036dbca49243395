// SPDX-License-Identifier: Apache-2.0
#include "platform/input/text_file.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "platform/input/input_file.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr int kGzipOnly = 16;  // added to the window's bits: no other format

// The members of a gzip file one after the other, which may be several.
std::string gunzip(std::vector<std::uint8_t>& bytes, const std::string& path, std::size_t largest) {
  z_stream stream{};
  inflateInit2(&stream, MAX_WBITS + kGzipOnly);
  const std::unique_ptr<z_stream, int (*)(z_stream*)> guard(&stream, inflateEnd);
  stream.next_in = bytes.data();
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::string text;
  std::array<char, 1 << 16> chunk;
  int state = Z_OK;
  while (state == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
    stream.avail_out = chunk.size();
    state = inflate(&stream, Z_NO_FLUSH);
    text.append(chunk.data(), chunk.size() - stream.avail_out);
    if (text.size() > largest) break;
    if (state == Z_STREAM_END && stream.avail_in > 0) state = inflateReset(&stream);
  }
  if (state != Z_STREAM_END && text.size() <= largest) {
    throw UserError(fmt::format("{}: damaged gzip file: {}", path,
                                state == Z_BUF_ERROR    ? "it ends too early"
                                : stream.msg == nullptr ? "unknown"
                                                        : stream.msg));
  }
  return text;
}

}  // namespace

std::string read_text_file(const std::string& path, std::size_t largest) {
  // Packed, a text that is short is longer by its head.
  constexpr std::size_t kHead = 1 << 16;
  std::vector<std::uint8_t> bytes = read_file(path, std::min(kMostFileBytes, largest + kHead));
  const bool packed = bytes.size() >= 2 && bytes[0] == 0x1f && bytes[1] == 0x8b;
  std::string text = packed ? gunzip(bytes, path, largest) : std::string(bytes.begin(), bytes.end());
  if (text.size() > largest) throw UserError(fmt::format("{}: a text of more than {} bytes", path, largest));
  if (text.compare(0, 3, "\xef\xbb\xbf") == 0) text.erase(0, 3);
  return text;
}

}  // namespace parallax
