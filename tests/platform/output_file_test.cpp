// SPDX-License-Identifier: Apache-2.0
#include "platform/results/output_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>

#include "tests/platform/error_line.hpp"
#include "tests/platform/temporary_folder.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace output_file_test {

using Bytes = std::vector<std::uint8_t>;

const Bytes kBytes{1, 2, 3};

Bytes content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::ptrdiff_t entries(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), {});
}

TEST(OutputFile, WritesAndReplaces) {
  const TemporaryFolder folder;
  write_file(folder / "a.bin", kBytes);
  EXPECT_EQ(content(folder / "a.bin"), kBytes);
  write_file(folder / "a.bin", Bytes{});
  EXPECT_TRUE(content(folder / "a.bin").empty());
  EXPECT_EQ(entries(folder.path()), 1);
}

TEST(OutputFile, FullDeviceIsAUserError) {
  if (!std::filesystem::exists("/dev/full")) {
    GTEST_SKIP() << "no /dev/full";
  }
  EXPECT_EQ(error_line<UserError>([] { write_file("/dev/full", kBytes); }),
            "cannot write /dev/full: No space left on device");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(OutputFile, UnlessPublishedNothingAppears) {
  const TemporaryFolder folder;
  {
    OutputFile file(folder / "a.bin");
    file.write("text");
    file.close();
    EXPECT_EQ(entries(folder.path()), 1);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.bin"));
  }
  EXPECT_EQ(entries(folder.path()), 0);
}

TEST(OutputFile, WhatAnEarlierAttemptLeftIsRemovedAndANameThatIsTakenIsNoFault) {
  const TemporaryFolder folder;
  folder.write(".a.bin.99.part", "left");
  folder.write(".b.bin.99.part", "of another file");
  folder.write(".a.bin." + std::to_string(::getpid()) + ".part", "left by a process of the same number");
  write_file(folder / "a.bin", kBytes);
  EXPECT_EQ(entries(folder.path()), 2);
  OutputFile first(folder / "a.bin"), second(folder / "a.bin");
  first.write("first");
  second.write("second");
  first.publish();
  EXPECT_EQ(folder.read("a.bin"), "first");
  second.publish();
  EXPECT_EQ(folder.read("a.bin"), "second");
  EXPECT_EQ(entries(folder.path()), 2);
}

TEST(OutputFile, NothingIsLeftWhenTheFileDoesNotFit) {
  const TemporaryFolder folder;
  write_file(folder / "a.bin", Bytes{7});
  // A limit on the file's size stops the write half way, as a full disk does.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 1000;
  ::setrlimit(RLIMIT_FSIZE, &small);
  const std::string line = error_line<UserError>([&] { write_file(folder / "a.bin", Bytes(100000, 1)); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(line, "cannot write " + (folder / "a.bin") + ": File too large");
  EXPECT_EQ(content(folder / "a.bin"), (Bytes{7}));
  EXPECT_EQ(entries(folder.path()), 1);
}

TEST(OutputFile, UnwritableTargetsAreUserErrors) {
  const TemporaryFolder folder;
  EXPECT_EQ(error_line<UserError>([&] { write_file(folder / "none/a.bin", Bytes{1}); }),
            "cannot write " + (folder / "none/a.bin") + ": No such file or directory");
  EXPECT_EQ(error_line<UserError>([&] { write_file(folder.path(), Bytes{1}); }),
            "cannot write " + folder.path().string() + ": Is a directory");
  write_file(folder / "file", Bytes{1});
  EXPECT_EQ(error_line<UserError>([&] { write_file(folder / "file/a.bin", Bytes{1}); }),
            "cannot write " + (folder / "file/a.bin") + ": Not a directory");
}

}  // namespace output_file_test
}  // namespace parallax
