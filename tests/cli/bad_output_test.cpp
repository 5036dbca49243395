// SPDX-License-Identifier: Apache-2.0
// A folder that cannot be written to, a disk or a memory that is full: one line, and nothing half written.
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/stat.h>

#include "tests/cli/bad_input.hpp"
#include "tests/paths.hpp"
#include "tests/platform/unprivileged.hpp"

namespace parallax {
namespace bad_output_test {

namespace fs = std::filesystem;
using test::BadInput;

TEST_F(BadInput, OutputFolder) {
  text("file", "mine");
  const auto refused = [&](const std::string& folder) {
    return error("--size 64x32 --out " + folder);  // of two --out, the last one counts
  };
  EXPECT_EQ(refused("file"), "cannot make the output folder file: file is a file");
  EXPECT_EQ(refused("file/deeper"), "cannot make the output folder file/deeper: file is a file");
  EXPECT_EQ(program_.read("file"), "mine");
  fs::create_directory(program_ / "locked");
  ::chmod((program_ / "locked").c_str(), 0555);
  ::chmod(program_.folder().path().c_str(), 0755);
  if (::geteuid() == 0) {
    const auto become_nobody = [] { static_cast<void>(::setuid(65534) == 0); };
    EXPECT_EQ(error("--size 64x32 --out locked", become_nobody),
              "cannot write to the output folder locked: Permission denied");
    EXPECT_EQ(error("--size 64x32 --out locked/deeper", become_nobody),
              "cannot make the output folder locked/deeper: Permission denied");
  } else {
    EXPECT_EQ(refused("locked"), "cannot write to the output folder locked: Permission denied");
  }
}

TEST_F(BadInput, AFileThatDoesNotFitLeavesNothing) {
  // A limit on the size of a file stops a write half way, as a full disk does.
  const auto limited = [] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{20000, 20000};
    ::setrlimit(RLIMIT_FSIZE, &small);
  };
  EXPECT_EQ(error("--size 160x128", limited).rfind("cannot write out/", 0), 0U);
  // timing.json is the last file: without it there are no results either.
  const auto all_but_timing = [] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{40000, 40000};
    ::setrlimit(RLIMIT_FSIZE, &small);
  };
  EXPECT_EQ(error("--size 64x48 --no-point-cloud", all_but_timing),
            "cannot write out/timing.json: File too large");
}

TEST_F(BadInput, AFullDiskLeavesNothing) {
  fs::create_directory(program_ / "disk");
  const std::string disk = (program_ / "disk").string();
  if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=64k") != 0) {
    GTEST_SKIP() << "a small file system can be mounted by root only";
  }
  const std::string line = error("--size 160x128 --out disk/new");
  ::umount(disk.c_str());
  EXPECT_EQ(line.rfind("cannot write disk/new/", 0), 0U);
  EXPECT_NE(line.find("No space left on device"), std::string::npos);
}

TEST_F(BadInput, ADiskThatFillsUpLeavesTheFramesBefore) {
  fs::create_directory(program_ / "disk");
  const std::string disk = (program_ / "disk").string();
  if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=800k") != 0) {
    GTEST_SKIP() << "a small file system can be mounted by root only";
  }
  const test::Outcome outcome = program_("run --disparities 32 --size 64x48 --frames 50 --out disk/new");
  const auto left = program_.files("disk/new");
  ::umount(disk.c_str());
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err.rfind("parallax: error: cannot write disk/new/frame_", 0), 0U) << outcome.err;
  EXPECT_EQ(test::lines(outcome.err).size(), 1U);
  EXPECT_GE(left.size(), 8U);
  EXPECT_EQ(left.size() % 8, 0U) << "whole frames: a folder and seven files each";
}

TEST_F(BadInput, ExhaustedMemoryIsOneLineToo) {
  if (test::sanitized()) GTEST_SKIP() << "the sanitizer reserves more than any limit";
  const auto limited = [] {
    const rlimit small{300U << 20U, 300U << 20U};
    ::setrlimit(RLIMIT_AS, &small);
  };
  EXPECT_EQ(error("--size 64x48", limited), "this computer cannot hold a memory of 536870912 bytes");
  // The dates of as many tokens do not fit.
  const test::Outcome outcome = program_(
      "run --size 64x48 --set memory.size_bytes=2097152 --set streams.left_output.depth=16000000", limited);
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "parallax: internal error: out of memory\n");
}

}  // namespace bad_output_test
}  // namespace parallax
