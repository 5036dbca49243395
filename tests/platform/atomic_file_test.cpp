// SPDX-License-Identifier: Apache-2.0
#include "platform/atomic_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>

#include "error_line.hpp"
#include "temporary_folder.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

std::vector<unsigned char> content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::ptrdiff_t entries(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), {});
}

TEST(AtomicFile, WritesAndReplaces) {
  const TemporaryFolder folder;
  write_atomically(folder / "a.bin", {1, 2, 3});
  EXPECT_EQ(content(folder / "a.bin"), (std::vector<unsigned char>{1, 2, 3}));
  write_atomically(folder / "a.bin", {});
  EXPECT_TRUE(content(folder / "a.bin").empty());
  EXPECT_EQ(entries(folder.path()), 1);
}

TEST(AtomicFile, FullDeviceIsAUserError) {
  if (!std::filesystem::exists("/dev/full")) {
    GTEST_SKIP() << "no /dev/full";
  }
  EXPECT_EQ(error_line<UserError>([] {
              write_atomically("/dev/full", {1, 2, 3});
            }),
            "cannot write /dev/full: No space left on device");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(AtomicFile, NothingIsLeftWhenTheFileDoesNotFit) {
  const TemporaryFolder folder;
  write_atomically(folder / "a.bin", {7});
  // A limit on the file's size stops the write half way, as a full disk does.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 1000;
  ::setrlimit(RLIMIT_FSIZE, &small);
  const std::string line = error_line<UserError>(
      [&] { write_atomically(folder / "a.bin", std::vector<unsigned char>(100000, 1)); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(line, "cannot write " + (folder / "a.bin").string() + ": File too large");
  EXPECT_EQ(content(folder / "a.bin"), (std::vector<unsigned char>{7}));
  EXPECT_EQ(entries(folder.path()), 1);
}

TEST(AtomicFile, UnwritableTargetsAreUserErrors) {
  const TemporaryFolder folder;
  EXPECT_EQ(error_line<UserError>([&] { write_atomically(folder / "none/a.bin", {1}); }),
            "cannot write " + (folder / "none/a.bin").string() + ": No such file or directory");
  EXPECT_EQ(error_line<UserError>([&] { write_atomically(folder.path(), {1}); }),
            "cannot write " + folder.path().string() + ": Is a directory");
  write_atomically(folder / "file", {1});
  EXPECT_EQ(error_line<UserError>([&] { write_atomically(folder / "file/a.bin", {1}); }),
            "cannot write " + (folder / "file/a.bin").string() + ": Not a directory");
}

}  // namespace
}  // namespace parallax
