// SPDX-License-Identifier: Apache-2.0
#include "platform/results/output_folder.hpp"

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

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
  EXPECT_EQ(entries(temporary.path()), 6U) << "three files, two folders, the index, no temporary file";
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

// What a command wrote into a folder at another time.
void write_results(const TemporaryFolder& temporary, const std::vector<const char*>& names) {
  OutputFolder folder(temporary.path());
  for (const char* name : names) folder.write(name, "old");
  folder.publish();
}

FolderPlan plan_of(const std::vector<std::string>& names) {
  FolderPlan plan;
  plan.writes = [names](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  plan.replaces = is_result_name;
  return plan;
}

TEST(OutputFolder, ReplacesOlderResultsOnlyWhenPublished) {
  TemporaryFolder temporary;
  write_results(temporary, {"a.json"});
  {
    OutputFolder folder(temporary.path());
    folder.write("a.json", "never finished");
  }
  EXPECT_EQ(temporary.read("a.json"), "old");
  OutputFolder folder(temporary.path());
  folder.write("a.json", "new");
  folder.publish();
  EXPECT_EQ(temporary.read("a.json"), "new");
  EXPECT_EQ(entries(temporary.path()), 2U);
}

TEST(OutputFolder, OldResultsGiveWayToThoseOfAnotherRun) {
  TemporaryFolder temporary;
  for (const char* name : {"deep/frame_0000/disparity.png", "frame_0003/note.txt", "mine.txt"})
    temporary.write(name, "old");
  write_results(temporary, {"timing.json", "disparity.png", "trace_rows.csv", "frame_0000/disparity.png",
                            "frame_0002/points.ply", "frame_0003/disparity.bin", "point_0001/timing.json"});
  {
    OutputFolder failed(temporary.path(), plan_of({"frame_0000/disparity.png"}));
    failed.write("frame_0000/disparity.png", "never finished");
  }
  EXPECT_EQ(temporary.read("timing.json"), "old");
  OutputFolder folder(temporary.path(), plan_of({"frame_0000/disparity.png"}));
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

TEST(OutputFolder, WhatItDidNotWriteItNeitherRemovesNorReplaces) {
  TemporaryFolder temporary;
  write_results(temporary, {"timing.json", "causes.png", "points.ply"});
  temporary.write("error.png", "mine");
  temporary.write("points.ply", "odl");  // as long as it was, and another one
  temporary.write("causes.png", "old and more");
  fs::remove(temporary / "timing.json");
  fs::create_symlink("elsewhere", temporary / "timing.json");
  {
    OutputFolder folder(temporary.path(), plan_of({"disparity.png"}));
    folder.write("disparity.png", "new");
    folder.publish();
  }
  EXPECT_EQ(temporary.read("error.png"), "mine");
  EXPECT_EQ(temporary.read("points.ply"), "odl");
  EXPECT_EQ(temporary.read("causes.png"), "old and more");
  EXPECT_TRUE(fs::is_symlink(temporary / "timing.json"));
  for (const char* name : {"error.png", "points.ply", "causes.png"}) {
    EXPECT_EQ(error_of([&] { OutputFolder folder(temporary.path(), plan_of({name})); }),
              temporary / name +
                  " would be replaced, but is no result as parallax wrote it there (.parallax_files); move "
                  "it away, "
                  "or choose another folder");
  }
}

TEST(OutputFolder, WhatAppearsMeanwhileIsNotReplaced) {
  TemporaryFolder temporary;
  {
    OutputFolder folder(temporary.path(), plan_of({"timing.json", "profile.json"}));
    folder.write("profile.json", "new");
    folder.write("timing.json", "new");
    temporary.write("timing.json", "mine");
    EXPECT_NE(error_of([&] { folder.publish(); }).find("timing.json would be replaced"), std::string::npos);
  }
  EXPECT_EQ(temporary.read("timing.json"), "mine");
  EXPECT_EQ(entries(temporary.path()), 1U);
}

TEST(OutputFolder, RefusesWhatWouldCostAnInput) {
  TemporaryFolder temporary;
  write_results(temporary, {"disparity.png", "left_rectified.png"});
  fs::create_symlink("disparity.png", temporary / "link.png");
  fs::create_hard_link(temporary / "left_rectified.png", temporary / "other.png");
  const auto refusal = [&](const std::string& input, const std::string& writes) {
    FolderPlan plan = plan_of({writes});
    plan.inputs = {{"--left " + input, temporary / input}};
    return error_of([&] { OutputFolder folder(temporary.path(), std::move(plan)); });
  };
  const auto line = [&](const std::string& input, const std::string& target) {
    return "--out " + temporary.path().string() + " would replace or remove --left " + input +
           ", which is read: " + temporary / target + " is the name of a result; choose another folder";
  };
  EXPECT_EQ(refusal("disparity.png", "disparity.png"), line("disparity.png", "disparity.png"));
  EXPECT_EQ(refusal("link.png", "timing.json"), line("link.png", "disparity.png")) << "as an old result";
  EXPECT_EQ(refusal("other.png", "left_rectified.png"), line("other.png", "left_rectified.png"));
  EXPECT_EQ(refusal("./../" + temporary.path().filename().string() + "/disparity.png", "disparity.png"),
            line("./../" + temporary.path().filename().string() + "/disparity.png", "disparity.png"));
}

TEST(OutputFolder, ADamagedIndexNamesNothing) {
  TemporaryFolder temporary;
  write_results(temporary, {"disparity.png"});
  const std::string mine = temporary.write("mine/note.txt", "old");
  temporary.write(
      ".parallax_files",
      "x\n\n3 zz disparity.png\n99999999999999999999999999 0 disparity.png\n3 0bb75bc4 ../mine/note.txt\n");
  {
    OutputFolder folder(temporary.path(), plan_of({"timing.json"}));
    folder.write("timing.json", "new");
    folder.publish();
  }
  EXPECT_EQ(temporary.read("disparity.png"), "old");
  EXPECT_EQ(temporary.read("mine/note.txt"), "old");
  fs::resize_file(temporary / ".parallax_files", std::uintmax_t{1} << 30);
  EXPECT_EQ(error_of([&] { OutputFolder again(temporary.path()); }),
            temporary / ".parallax_files" +
                " has 1073741824 bytes, which no list of results has; choose another folder");
  fs::remove(temporary / ".parallax_files");
  fs::create_directory(temporary / ".parallax_files");
  EXPECT_EQ(
      error_of([&] { OutputFolder again(temporary.path()); }),
      temporary / ".parallax_files" + " is not a file, but results are listed there; choose another folder");
}

TEST(OutputFolder, RemovesWhatAProcessThatWasKilledLeft) {
  TemporaryFolder temporary;
  const pid_t child = ::fork();
  if (child == 0) {
    OutputFolder folder(temporary.path(), plan_of({}));
    folder.write("frame_0000/disparity.png", "half");
    folder.open("trace.json").write("half");
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(entries(temporary.path()), 3U) << "two files and a folder";
  temporary.write(".movie.123.part", "mine");
  // Of a process that lives, on another machine say, where this one's locks do not reach.
  OutputFile running(temporary / "timing.json");
  running.write("of one that lives");
  {
    OutputFolder folder(temporary.path(), plan_of({}));
    EXPECT_EQ(entries(temporary.path()), 2U);
    EXPECT_EQ(temporary.read(".movie.123.part"), "mine");
  }
  running.publish();
  EXPECT_EQ(temporary.read("timing.json"), "of one that lives");
}

TEST(OutputFolder, OneWritesThereAtATime) {
  TemporaryFolder temporary;
  const std::string path = temporary / "results";
  const std::string refused =
      "another parallax is writing to " + path + "; wait until it ends, or choose another folder";
  {
    OutputFolder first(path, plan_of({"timing.json"}));
    EXPECT_EQ(error_of([&] { OutputFolder second(path, plan_of({"timing.json"})); }), refused);
    EXPECT_EQ(error_of([&] { OutputFolder second(path + "/../results/"); }).rfind("another parallax", 0), 0U);
    first.write("timing.json", "first");
    first.publish();
    EXPECT_EQ(error_of([&] { OutputFolder second(path, plan_of({"timing.json"})); }), refused);
  }
  const pid_t child = ::fork();
  if (child == 0) {
    OutputFolder killed(path, plan_of({"timing.json"}));
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  OutputFolder last(path, plan_of({"timing.json"}));
  last.write("timing.json", "last");
  last.publish();
  EXPECT_EQ(temporary.read("results/timing.json"), "last");
}

TEST(OutputFolder, AFolderThatWasRemovedIsNotTheOneThatIsLocked) {
  TemporaryFolder temporary;
  const std::string path = temporary / "results";
  fs::create_directory(path);
  const FolderLock lock(path);
  EXPECT_TRUE(lock.is_at(path));
  fs::remove(path);
  EXPECT_FALSE(lock.is_at(path));
  fs::create_directory(path);
  EXPECT_FALSE(lock.is_at(path));
  const FolderLock other(path);
  EXPECT_TRUE(other.is_at(path));
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
  EXPECT_EQ(entries(temporary.path() / "results"), 2U) << "and the index";
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
