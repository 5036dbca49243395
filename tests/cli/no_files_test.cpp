// SPDX-License-Identifier: Apache-2.0
// Folders, pipes, devices and sockets in the place of files, for every option and argument that takes one:
// one line, and at once.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <chrono>

#include "tests/cli/program.hpp"

namespace parallax {
namespace no_files_test {

namespace fs = std::filesystem;

class NoFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(program_("scene --rectified --size 64x48 --disparities 32 --out in").code, 0);
    ASSERT_EQ(program_("run -q --timing-only --no-verdict --size 64x48 -d 32 --out results").code, 0);
    fs::create_directory(program_ / "folder");
    ::mkfifo((program_ / "pipe").c_str(), 0600);
    const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string path = program_ / "socket";
    ASSERT_LT(path.size(), sizeof address.sun_path);
    path.copy(address.sun_path, path.size());
    ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    ::close(socket);
    fs::create_symlink("/dev/zero", program_ / "zero");
  }

  /// The error line, without what is before it.
  std::string error(const std::string& arguments) const {
    const auto begin = std::chrono::steady_clock::now();
    const test::Outcome outcome = program_(arguments, [] {
      const rlimit memory{rlim_t{1} << 30, rlim_t{1} << 30};
      if (!test::sanitized()) ::setrlimit(RLIMIT_AS, &memory);
      ::alarm(30);
    });
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10)) << arguments;
    EXPECT_EQ(outcome.code, 2) << arguments << '\n' << outcome.err;
    EXPECT_EQ(outcome.out, "") << arguments;
    const auto lines = test::lines(outcome.err);
    EXPECT_EQ(lines.size(), 1U) << arguments << '\n' << outcome.err;
    const std::string prefix = "parallax: error: ";
    return lines.empty() || lines[0].rfind(prefix, 0) != 0 ? outcome.err : lines[0].substr(prefix.size());
  }

  test::Program program_;
};

TEST_F(NoFiles, WhereAFileIsExpected) {
  const std::string pair = "run -d 32 --left in/left.png --right in/right.png ";
  for (const std::string command :
       {"run --input ",
        "run --left in/left.png --right ",
        "run --right in/right.png --left ",
        "run -d 32 --left in/left.png --right in/right.png --calibration ",
        "run -d 32 --left in/left.png --right in/right.png --calibration in/calib.yml ",
        "run -d 32 --left in/left.png --right in/right.png --map ",
        "run -d 32 --left in/left.png --right in/right.png --ground-truth ",
        "run -d 32 --left in/left.png --right in/right.png --ground-truth in/disp_gt.png --mask ",
        "run --preset ./",
        "run --set memory.device=./",
        "config --preset ./",
        "validate --rows ./",
        "validate --preset ./",
        "map encode -o m --calibration ",
        "map encode -o m --maps ",
        "map decode -o m.yml ",
        "map info ",
        "memory in/left.png --config ./",
        "compare-runs results ",
        "compare-runs --html page.html "}) {
    const std::string rest = command == "compare-runs --html page.html " ? " results" : "";
    for (const auto& [name, kind] :
         {std::pair("pipe", "a pipe"), {"socket", "a socket"}, {"zero", "a device"}}) {
      const std::string line = error(command + name + rest);
      const bool image = line.find(" is no file, expected a") != std::string::npos;
      EXPECT_TRUE(image || line.find(std::string(" is ") + kind + ", expected ") != std::string::npos)
          << command << name << ": " << line;
      EXPECT_FALSE(fs::exists(program_ / "m"));
    }
    const std::string line = error(command + "folder" + rest);
    EXPECT_NE(line.find("folder"), std::string::npos) << line;
  }
  EXPECT_EQ(error("map encode -o m --maps pipe pipe pipe pipe"), "pipe is no file, expected a map");
  EXPECT_EQ(error("run --input zero"), "zero is a device, expected a folder or a list of image pairs");
  EXPECT_EQ(error(pair + "--calibration pipe"), "pipe is a pipe, expected a file");
  EXPECT_EQ(error("config -p ./zero"), "./zero is a device, expected a preset file");
  EXPECT_EQ(error("memory in/left.png --config ./pipe").rfind("./pipe is a pipe, expected a ", 0), 0U);
}

TEST_F(NoFiles, AmongTheResultsOfARun) {
  for (const char* file : {"timing.json", "profile.json", "relaxations.json"}) {
    const fs::path path = program_ / "results" / file;
    std::error_code not_there;
    fs::rename(path, program_ / "kept", not_there);
    ::mkfifo(path.c_str(), 0600);
    EXPECT_EQ(error("report results"),
              "results/" + std::string(file) + " is a pipe, expected results of a run");
    fs::remove(path);
    fs::rename(program_ / "kept", path, not_there);
  }
}

TEST_F(NoFiles, AListOfPairsIsText) {
  EXPECT_EQ(
      error("run --input in/left.png"),
      "in/left.png is no list of pairs, as it is no text; expected two paths a line: left right; a pair "
      "goes with --left and --right");
  const std::string name(5000, 'x');
  program_.folder().write("list.txt", name + " right.png\n");
  EXPECT_EQ(error("run --input list.txt"), "list.txt:1: " + name.substr(0, 200) + "... does not exist");
  program_.folder().write("many.txt", std::string((64 << 20) + 1, ' '));
  EXPECT_EQ(error("run --input many.txt"), "many.txt: a text of more than 67108864 bytes");
  fs::resize_file(program_ / "many.txt", std::uintmax_t{1} << 30);
  EXPECT_EQ(error("run --input many.txt"), "many.txt: has more than 64 MiB, the most that is read");
  EXPECT_EQ(error("map encode -o m --calibration many.txt"),
            "many.txt: has more than 16 MiB, the most that is read");
}

TEST_F(NoFiles, ATraceMayComeThroughAPipeIntoWhichSomebodyWrites) {
  EXPECT_EQ(error("memory --config ddr3-1066-x32 pipe"), "pipe is a pipe into which nobody writes");
  EXPECT_EQ(error("memory --config ddr3-1066-x32 socket"),
            "socket: cannot be read: No such device or address");
  EXPECT_EQ(error("memory --config ddr3-1066-x32 folder"), "folder: cannot be read: Is a directory");
  EXPECT_EQ(error("memory --config ddr3-1066-x32 zero"), "zero:1: has more than 1000 characters");
  EXPECT_EQ(error("memory --config ddr3-1066-x32 /dev/null"), "/dev/null: holds no request");
  for (const int seconds : {0, 2}) {
    const pid_t writer = ::fork();
    if (writer == 0) {
      const int pipe = ::open((program_ / "pipe").c_str(), O_WRONLY);
      ::sleep(static_cast<unsigned>(seconds));
      const std::string trace = "time_ns,rw,addr,bytes\n0,R,0x0,64\n";
      ::_exit(::write(pipe, trace.data(), trace.size()) < 0);
    }
    const test::Outcome outcome = program_("memory --config ddr3-1066-x32 pipe");
    int status = 0;
    ::waitpid(writer, &status, 0);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("1 requests"), std::string::npos) << outcome.out;
  }
}

TEST_F(NoFiles, ResultsDoNotGoIntoThem) {
  for (const char* name : {"pipe", "socket", "zero"}) {
    EXPECT_EQ(error("run -d 32 --size 64x48 --out " + std::string(name)),
              "cannot make the output folder " + std::string(name) + ": " + name + " is a file");
  }
}

TEST_F(NoFiles, TwoRunsIntoOneFolder) {
  const pid_t first = program_.start("run -q -d 32 --size 64x48 --frames 100000 --no-verdict --out both");
  while (!fs::exists(program_ / "both/frame_0003/disparity.png")) ::usleep(10'000);
  for (const std::string command : {"run -d 32 --size 64x48 --out both", "scene --size 64x48 --out both",
                                    "run --timing-only --vary clocks.core_hz=1e8,2e8 --out both",
                                    "run --timing-only --relax --out both"}) {
    EXPECT_EQ(error(command),
              "another parallax is writing to both; wait until it ends, or choose another folder");
  }
  ::kill(first, SIGKILL);
  EXPECT_EQ(program_.wait(first).code, 1000 + SIGKILL);
  for (const char* folder : {"both", "fresh"})
    EXPECT_EQ(program_("run -q -d 32 --size 64x48 --no-verdict --out " + std::string(folder)).code, 0);
  // A run that is killed between making a folder and writing into it leaves that.
  const auto without_folders = [](std::vector<std::string> names) {
    names.erase(
        std::remove_if(names.begin(), names.end(), [](const std::string& n) { return n.back() == '/'; }),
        names.end());
    return names;
  };
  EXPECT_EQ(without_folders(program_.files("both")), without_folders(program_.files("fresh")))
      << "nothing of the run that was killed";
}

}  // namespace no_files_test
}  // namespace parallax
