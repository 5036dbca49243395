// SPDX-License-Identifier: Apache-2.0
// The program in a process of its own, as its user sees it.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "platform/results/file_index.hpp"
#include "tests/paths.hpp"
#include "tests/platform/temporary_folder.hpp"

namespace parallax::test {

struct Outcome {
  int code = -1;  ///< exit code; 1000 + the signal when one ended the program
  std::string out;
  std::string err;
};

/// Runs the program with a folder of its own as the working directory: the files of a test are there.
class Program {
 public:
  const TemporaryFolder& folder() const { return folder_; }
  std::filesystem::path operator/(const std::string& name) const { return folder_.path() / name; }
  std::string read(const std::string& name) const { return folder_.read(name); }

  /// `arguments` are separated by blanks, '' is an empty one. `prepare` runs in the child before the program
  /// does.
  Outcome operator()(const std::string& arguments, const std::function<void()>& prepare = {}) const {
    return wait(start(arguments, prepare));
  }

  pid_t start(const std::string& arguments, const std::function<void()>& prepare = {}) const {
    std::istringstream words(arguments);
    std::vector<std::string> list{program_path()};
    for (std::string word; words >> word;) list.push_back(word == "''" ? "" : word);
    std::vector<char*> argv;
    for (std::string& word : list) argv.push_back(word.data());
    argv.push_back(nullptr);
    const pid_t child = ::fork();
    if (child != 0) return child;
    std::signal(SIGINT, SIG_DFL);  // whoever started the tests in the background ignores it
    redirect(out_ / "out", STDOUT_FILENO);
    redirect(out_ / "err", STDERR_FILENO);
    if (::chdir(folder_.path().c_str()) != 0) ::_exit(126);
    if (prepare) prepare();
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }

  Outcome wait(pid_t child) const {
    int status = 0;
    if (::waitpid(child, &status, 0) != child) throw std::runtime_error("cannot wait for the program");
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status), out_.read("out"),
            out_.read("err")};
  }

  /// Everything below the working directory but lists of results, sorted, folders with a slash at the end.
  std::vector<std::string> files(const std::string& below = "") const {
    std::vector<std::string> names;
    const std::filesystem::path root = folder_.path() / below;
    if (!std::filesystem::exists(root)) return names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
      if (entry.path().filename() == FileIndex::kName) continue;
      names.push_back(std::filesystem::relative(entry.path(), root).string() +
                      (entry.is_directory() ? "/" : ""));
    }
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  static void redirect(const std::string& path, int descriptor) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    ::dup2(file, descriptor);
    ::close(file);
  }

  TemporaryFolder folder_;
  TemporaryFolder out_;
};

/// The lines of a text.
inline std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> list;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) list.push_back(line);
  return list;
}

}  // namespace parallax::test
