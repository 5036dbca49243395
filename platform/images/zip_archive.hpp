// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace parallax {

/// A file of a zip archive.
struct ZipMember {
  std::string name;
  std::uint64_t bytes = 0;   ///< unpacked
  std::uint64_t packed = 0;  ///< bytes in the archive
  std::uint64_t header = 0;  ///< where its own header is
  std::uint32_t crc = 0;     ///< of the unpacked bytes
  int method = 0;            ///< 0: as it is, 8: deflate
  bool encrypted = false;
};

/// A zip archive that is read without unpacking more than is asked for. Sizes beyond 4 GiB (zip64) are not
/// read. Every fault of the file is a UserError of one line.
class ZipArchive {
 public:
  /// Whether a file that begins so may be an archive.
  static bool begins(const std::vector<std::uint8_t>& bytes);

  /// Reads the directory at its end.
  explicit ZipArchive(std::string path);

  const std::vector<ZipMember>& members() const { return members_; }

  /// The first `most` bytes of a member, or all, whose checksum is right then.
  std::vector<std::uint8_t> read(const ZipMember& member, std::uint64_t most);

 private:
  std::vector<std::uint8_t> bytes_at(std::uint64_t at, std::uint64_t count);
  void read_directory(std::uint64_t at, std::uint64_t bytes, std::uint64_t count);
  [[noreturn]] void damaged(const std::string& why) const;

  std::string path_;
  std::ifstream file_;
  std::uint64_t size_ = 0;
  std::vector<ZipMember> members_;
};

}  // namespace parallax
