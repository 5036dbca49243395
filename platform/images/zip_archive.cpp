// SPDX-License-Identifier: Apache-2.0
#include "platform/images/zip_archive.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "platform/images/sample_bytes.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

// Records of the format (PKWARE's APPNOTE, 4.3), each with its signature and its length without names.
constexpr std::uint32_t kLocalSignature = 0x04034B50, kEntrySignature = 0x02014B50,
                        kEndSignature = 0x06054B50;
constexpr std::size_t kLocalBytes = 30, kEntryBytes = 46, kEndBytes = 22;
constexpr std::uint64_t kLongestComment = 0xFFFF;
constexpr std::uint64_t kInZip64 = 0xFFFFFFFF;  // the number stands elsewhere
constexpr int kStored = 0, kDeflated = 8;

template <class T>
T number_at(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  return number_of_bytes<T>(bytes.data() + at, false);
}

// As many bytes as `wanted`, or fewer when the data are damaged or end.
std::vector<std::uint8_t> inflated(std::vector<std::uint8_t>& packed, std::uint64_t wanted) {
  z_stream stream{};
  inflateInit2(&stream, -MAX_WBITS);
  const std::unique_ptr<z_stream, int (*)(z_stream*)> guard(&stream, inflateEnd);
  std::vector<std::uint8_t> bytes(wanted);
  stream.next_in = packed.data();
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = bytes.data();
  stream.avail_out = static_cast<uInt>(bytes.size());
  inflate(&stream, Z_FINISH);
  bytes.resize(stream.total_out);
  return bytes;
}

}  // namespace

bool ZipArchive::begins(const std::vector<std::uint8_t>& bytes) {
  return bytes.size() >= 4 && (number_at<std::uint32_t>(bytes, 0) == kLocalSignature ||
                               number_at<std::uint32_t>(bytes, 0) == kEndSignature);
}

ZipArchive::ZipArchive(std::string path)
    : path_(std::move(path)), file_(path_, std::ios::binary | std::ios::ate) {
  size_ = file_ ? static_cast<std::uint64_t>(std::max<std::streamoff>(0, file_.tellg())) : 0;
  const std::uint64_t tail = std::min(size_, kEndBytes + kLongestComment);
  const std::vector<std::uint8_t> bytes = bytes_at(size_ - tail, tail);
  for (std::size_t left = bytes.size(); left >= kEndBytes; --left) {
    const std::size_t at = left - kEndBytes;
    if (number_at<std::uint32_t>(bytes, at) != kEndSignature) continue;
    read_directory(number_at<std::uint32_t>(bytes, at + 16), number_at<std::uint32_t>(bytes, at + 12),
                   number_at<std::uint16_t>(bytes, at + 10));
    return;
  }
  damaged("it has no directory at its end");
}

void ZipArchive::damaged(const std::string& why) const {
  throw UserError(fmt::format("{}: a damaged archive: {}", path_, why));
}

std::vector<std::uint8_t> ZipArchive::bytes_at(std::uint64_t at, std::uint64_t count) {
  if (at > size_ || count > size_ - at) damaged("it ends too early");
  std::vector<std::uint8_t> bytes(count);
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(at));
  file_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count));
  if (!file_ && count > 0) damaged("it cannot be read to its end");
  return bytes;
}

void ZipArchive::read_directory(std::uint64_t at, std::uint64_t bytes, std::uint64_t count) {
  constexpr std::uint64_t kLargestDirectory = std::uint64_t{1} << 24;
  if (bytes > kLargestDirectory) damaged("its directory is too large");
  const std::vector<std::uint8_t> directory = bytes_at(at, bytes);
  for (std::size_t entry = 0; members_.size() < count;) {
    if (directory.size() - entry < kEntryBytes ||
        number_at<std::uint32_t>(directory, entry) != kEntrySignature)
      damaged("its directory ends too early");
    ZipMember member;
    constexpr int kEncrypted = 1;
    member.encrypted = (number_at<std::uint16_t>(directory, entry + 8) & kEncrypted) != 0;
    member.method = number_at<std::uint16_t>(directory, entry + 10);
    member.crc = number_at<std::uint32_t>(directory, entry + 16);
    member.packed = number_at<std::uint32_t>(directory, entry + 20);
    member.bytes = number_at<std::uint32_t>(directory, entry + 24);
    member.header = number_at<std::uint32_t>(directory, entry + 42);
    const std::size_t name = number_at<std::uint16_t>(directory, entry + 28);
    const std::size_t rest = std::size_t{number_at<std::uint16_t>(directory, entry + 30)} +
                             number_at<std::uint16_t>(directory, entry + 32);
    entry += kEntryBytes;
    if (directory.size() - entry < name + rest) damaged("its directory ends too early");
    member.name.assign(directory.begin() + static_cast<std::ptrdiff_t>(entry),
                       directory.begin() + static_cast<std::ptrdiff_t>(entry + name));
    entry += name + rest;
    members_.push_back(std::move(member));
  }
}

std::vector<std::uint8_t> ZipArchive::read(const ZipMember& member, std::uint64_t most) {
  const auto refuse = [&](const std::string& why) {
    return UserError(fmt::format("{}: {}: {}", path_, excerpt(member.name), why));
  };
  if (member.bytes == kInZip64 || member.packed == kInZip64 || member.header == kInZip64)
    throw refuse("has 4 GiB or more");
  if (member.encrypted) throw refuse("is encrypted");
  if (member.method != kStored && member.method != kDeflated)
    throw refuse(fmt::format("is packed by method {}, expected deflate (8) or none (0)", member.method));
  // Only the directory's numbers count: a local header may leave sizes to what follows, or to zip64.
  const std::vector<std::uint8_t> head = bytes_at(member.header, kLocalBytes);
  if (number_at<std::uint32_t>(head, 0) != kLocalSignature) throw refuse("is not where the directory says");
  const std::uint64_t data =
      member.header + kLocalBytes + number_at<std::uint16_t>(head, 26) + number_at<std::uint16_t>(head, 28);
  const std::uint64_t wanted = std::min(most, member.bytes);
  if (member.method == kStored && member.packed != member.bytes)
    throw refuse(fmt::format("is damaged: {} bytes, and {} unpacked", member.packed, member.bytes));
  // Deflated data are hardly longer than what they hold.
  std::vector<std::uint8_t> bytes = bytes_at(
      data, std::min(member.packed, member.method == kStored ? wanted : 2 * wanted + kLongestComment));
  if (member.method == kDeflated) bytes = inflated(bytes, wanted);
  const bool whole = wanted == member.bytes;
  if (bytes.size() != wanted ||
      (whole && ::crc32(0, bytes.data(), static_cast<uInt>(bytes.size())) != member.crc))
    throw refuse("is damaged: its checksum is another");
  return bytes;
}

}  // namespace parallax
