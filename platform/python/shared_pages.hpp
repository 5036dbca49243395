// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

namespace parallax {

/// Memory of this process; given back when the object goes.
class MappedPages {
 public:
  /// What a descriptor of a file holds. Throws std::system_error.
  MappedPages(int descriptor, std::size_t size);
  ~MappedPages();
  MappedPages(const MappedPages&) = delete;
  MappedPages& operator=(const MappedPages&) = delete;

  std::byte* data() const { return data_; }
  std::size_t size() const { return size_; }

 private:
  std::byte* data_ = nullptr;
  const std::size_t size_;
};

/// What a process writes and the one that it is a copy of reads, without a copy: pages of memory that both
/// know by a descriptor.
class SharedPages {
 public:
  /// Throws std::system_error.
  SharedPages();
  ~SharedPages();
  SharedPages(const SharedPages&) = delete;
  SharedPages& operator=(const SharedPages&) = delete;

  /// Adds bytes at a multiple of 64 and returns where. Throws std::system_error when there is no memory left.
  std::size_t append(const void* bytes, std::size_t size);
  /// All that was added, by whichever process; null when nothing was.
  std::unique_ptr<MappedPages> map() const;

 private:
  int descriptor_ = -1;
  std::size_t end_ = 0;
};

}  // namespace parallax
