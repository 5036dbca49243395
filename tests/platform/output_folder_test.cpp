// SPDX-License-Identifier: Apache-2.0
#include "platform/results/output_folder.hpp"

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <unistd.h>

#include "platform/results/result_names.hpp"
#include "tests/platform/error_of.hpp"
#include "tests/platform/temporary_folder.hpp"
#include "tests/platform/unprivileged.hpp"

namespace parallax {
namespace output_folder_test {

namespace fs = std::filesystem;

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::recursive_directory_iterator(folder), {}));
}

TEST(OutputFolder, FilesAppearTogetherWhenPublished) {
  TemporaryFolder temporary;
  OutputFolder folder(temporary.path());
  folder.write("a.json", "text");
  folder.open("deep/er/b.bin").write("\0\1", 2);
  folder.write("c.png", std::vector<unsigned char>{'x'});
  EXPECT_FALSE(fs::exists(temporary / "a.json"));
  EXPECT_FALSE(fs::exists(temporary / "deep/er/b.bin"));
  folder.publish();
  EXPECT_EQ(temporary.read("a.json"), "text");
  EXPECT_EQ(temporary.read("deep/er/b.bin"), std::string("\0\1", 2));
  EXPECT_EQ(temporary.read("c.png"), "x");
  EXPECT_EQ(entries(temporary.path()), 5U) << "three files, two folders, no temporary file";
}

TEST(OutputFolder, OpenedFilesGoOnWhileWrittenOnesArePublished) {
  TemporaryFolder temporary;
  OutputFolder folder(temporary.path());
  OutputFile& trace = folder.open("trace.csv");
  trace.write("first,");
  folder.write("frame_0000/a.png", "x");
  folder.publish_written();
  EXPECT_EQ(temporary.read("frame_0000/a.png"), "x");
  EXPECT_FALSE(fs::exists(temporary / "trace.csv"));
  trace.write("second");
  folder.publish();
  EXPECT_EQ(temporary.read("trace.csv"), "first,second");
}

TEST(OutputFolder, ReplacesOlderResultsOnlyWhenPublished) {
  TemporaryFolder temporary;
  temporary.write("a.json", "old");
  {
    OutputFolder folder(temporary.path());
    folder.write("a.json", "never finished");
  }
  EXPECT_EQ(temporary.read("a.json"), "old");
  OutputFolder folder(temporary.path());
  folder.write("a.json", "new");
  folder.publish();
  EXPECT_EQ(temporary.read("a.json"), "new");
  EXPECT_EQ(entries(temporary.path()), 1U);
}

TEST(OutputFolder, OldResultsGiveWayToThoseOfAnotherRun) {
  TemporaryFolder temporary;
  for (const char* name : {"timing.json", "disparity.png", "mine.txt", "trace_rows.csv"})
    temporary.write(name, "old");
  for (const char* folder : {"frame_0000", "frame_0002", "frame_0003", "deep/frame_0000", "point_0001"}) {
    fs::create_directories(temporary / folder);
  }
  for (const char* name :
       {"frame_0000/disparity.png", "frame_0002/points.ply", "frame_0003/disparity.bin",
        "frame_0003/note.txt", "deep/frame_0000/disparity.png", "point_0001/timing.json"}) {
    temporary.write(name, "old");
  }
  {
    OutputFolder failed(temporary.path());
    failed.replace(is_result_name);
    failed.write("frame_0000/disparity.png", "never finished");
  }
  EXPECT_EQ(temporary.read("timing.json"), "old");
  OutputFolder folder(temporary.path());
  folder.replace(is_result_name);
  folder.write("frame_0000/disparity.png", "new");
  folder.publish();
  EXPECT_EQ(temporary.read("frame_0000/disparity.png"), "new");
  for (const char* gone : {"timing.json", "disparity.png", "trace_rows.csv", "frame_0002",
                           "frame_0003/disparity.bin", "point_0001"}) {
    EXPECT_FALSE(fs::exists(temporary / gone)) << gone;
  }
  for (const char* kept : {"mine.txt", "frame_0003/note.txt", "deep/frame_0000/disparity.png"}) {
    EXPECT_EQ(temporary.read(kept), "old") << kept;
  }
  folder.write("timing.json", "new");
  folder.publish();  // the second time nothing is removed
  EXPECT_EQ(temporary.read("frame_0000/disparity.png"), "new");
}

TEST(OutputFolder, LeavesNothingOfARunThatFailed) {
  TemporaryFolder temporary;
  {
    OutputFolder folder(temporary.path() / "new" / "results");
    folder.write("sub/a.json", "half");
    EXPECT_TRUE(fs::exists(temporary / "new/results/sub"));
  }
  EXPECT_EQ(entries(temporary.path()), 0U);
}

TEST(OutputFolder, KeepsWhatWasPublishedBefore) {
  TemporaryFolder temporary;
  {
    OutputFolder folder(temporary.path() / "results");
    folder.write("frame0.png", "done");
    folder.publish();
    folder.write("frame1.png", "half");
  }
  EXPECT_EQ(entries(temporary.path() / "results"), 1U);
}

TEST(OutputFolder, TakesAFolderWithATrailingSlash) {
  TemporaryFolder temporary;
  OutputFolder folder(temporary / "results/");
  folder.write("a", "");
  folder.publish();
  EXPECT_TRUE(fs::exists(temporary / "results/a"));
}

TEST(OutputFolder, RefusesAFileInItsPlace) {
  TemporaryFolder temporary;
  const std::string file = temporary.write("results", "");
  EXPECT_EQ(error_of([&] { OutputFolder folder(file); }),
            "cannot make the output folder " + file + ": " + file + " is a file");
  EXPECT_EQ(error_of([&] { OutputFolder folder(file + "/run1"); }),
            "cannot make the output folder " + file + "/run1: " + file + " is a file");
  EXPECT_EQ(error_of([&] { OutputFolder folder(""); }), "the name of the output folder is empty");
}

TEST(OutputFolder, RefusesAFolderInAFilesPlace) {
  TemporaryFolder temporary;
  fs::create_directory(temporary / "a.json");
  OutputFolder folder(temporary.path());
  EXPECT_EQ(error_of([&] { folder.write("a.json", ""); }),
            "cannot write " + (temporary / "a.json") + ": Is a directory");
}

TEST(OutputFolder, RefusesAFolderThatCannotBeMade) {
  EXPECT_EQ(error_of([] {
              OutputFolder folder("/proc/results");
            }).rfind("cannot make the output folder /proc/results: ", 0),
            0U);
}

TEST(OutputFolder, RefusesAFolderThatCannotBeWritten) {
  TemporaryFolder temporary;
  const std::string locked = temporary / "locked";
  fs::create_directory(locked);
  ::chmod(temporary.path().c_str(), 0755);
  ::chmod(locked.c_str(), 0555);
  const Unprivileged unprivileged;
  EXPECT_EQ(error_of([&] { OutputFolder folder(locked); }),
            "cannot write to the output folder " + locked + ": Permission denied");
  EXPECT_EQ(error_of([&] { OutputFolder folder(locked + "/new/results"); }),
            "cannot make the output folder " + locked + "/new/results: Permission denied");
}

TEST(OutputFolder, PublishesNothingOnAFullDisk) {
  TemporaryFolder temporary;
  if (::mount("tmpfs", temporary.path().c_str(), "tmpfs", 0, "size=64k") != 0) {
    GTEST_SKIP() << "a small file system can be mounted by root only";
  }
  {
    OutputFolder folder(temporary.path() / "results");
    const std::string line = error_of([&] {
      folder.write("small.json", "fits");
      folder.write("large.png", std::string(1 << 20, 'x'));
    });
    EXPECT_EQ(line, "cannot write " + (temporary / "results/large.png") + ": No space left on device");
  }
  EXPECT_EQ(entries(temporary.path()), 0U);
  ::umount(temporary.path().c_str());
}

}  // namespace output_folder_test
}  // namespace parallax
