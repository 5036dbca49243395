// SPDX-License-Identifier: Apache-2.0
#include "platform/python/shared_pages.hpp"

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace parallax {
namespace {

constexpr std::size_t kAlignment = 64;  // bytes: a cache line, and more than any element needs

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

}  // namespace

MappedPages::MappedPages(int descriptor, std::size_t size) : size_(size) {
  void* const pages = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  if (pages == MAP_FAILED) fail("the results cannot be mapped");
  data_ = static_cast<std::byte*>(pages);
}

MappedPages::~MappedPages() { ::munmap(data_, size_); }

SharedPages::SharedPages() : descriptor_(::memfd_create("parallax", MFD_CLOEXEC)) {
  if (descriptor_ < 0) fail("no memory for the results");
}

SharedPages::~SharedPages() { ::close(descriptor_); }

std::size_t SharedPages::append(const void* bytes, std::size_t size) {
  const std::size_t begin = (end_ + kAlignment - 1) / kAlignment * kAlignment;
  const auto* const from = static_cast<const char*>(bytes);
  for (std::size_t done = 0; done < size;) {
    const ssize_t count = ::pwrite(descriptor_, from + done, size - done, static_cast<off_t>(begin + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail("no memory for the results");
    done += static_cast<std::size_t>(count);
  }
  end_ = begin + size;
  return begin;
}

std::unique_ptr<MappedPages> SharedPages::map() const {
  struct stat now {};
  if (::fstat(descriptor_, &now) != 0) fail("the results cannot be mapped");
  if (now.st_size == 0) return nullptr;
  return std::make_unique<MappedPages>(descriptor_, static_cast<std::size_t>(now.st_size));
}

}  // namespace parallax
