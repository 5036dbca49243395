// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/circuit_build.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <regex>
#include <sstream>
#include <string_view>
#include <utility>

#include "tlm/error.hpp"

extern char** environ;

namespace parallax {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

// A folder for what is made on the way.
class BuildFolder {
 public:
  BuildFolder() {
    const char* const wanted = std::getenv("TMPDIR");
    const fs::path parent = wanted != nullptr && *wanted != '\0' ? wanted : "/tmp";
    std::string name = (parent / "parallax-circuit-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw UserError(fmt::format("cannot make a folder in {}: {}", parent.string(), std::strerror(errno)));
    }
    path_ = name;
  }
  ~BuildFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  BuildFolder(const BuildFolder&) = delete;
  BuildFolder& operator=(const BuildFolder&) = delete;
  const fs::path& path() const { return path_; }
  fs::path keep() { return std::exchange(path_, {}); }

 private:
  fs::path path_;
};

std::string content(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// The line in which a tool says what is wrong: the first with the word, else the last one.
std::string complaint(const std::string& said, const char* word) {
  std::istringstream lines(said);
  std::string last;
  for (std::string line; std::getline(lines, line);) {
    if (line.find(word) != std::string::npos) return line;
    if (!line.empty()) last = line;
  }
  return last;
}

// With what the user can do about a file that is not found.
std::string with_remedy(const std::string& complaint) {
  if (complaint.find("Cannot find include file") != std::string::npos)
    return complaint + "; --circuit-include DIR says where it is";
  if (complaint.find("Cannot find file containing module") != std::string::npos)
    return complaint + "; several files may be given, or --circuit-include DIR says where it is";
  if (complaint.find("Define or directive not defined") != std::string::npos)
    return complaint + "; --circuit-define NAME[=VALUE] defines it";
  return complaint;
}

// Runs a tool; what it says goes into a file of the folder. UserError when it is missing or fails.
std::string run_tool(const Words& words, const fs::path& folder, const char* package,
                     const char* error_word) {
  const fs::path log = folder / "log";
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                     0600);
  ::posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  std::vector<char*> argv;
  Words copies = words;
  for (std::string& word : copies) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t process = -1;
  const int failed = ::posix_spawnp(&process, argv[0], &actions, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failed == ENOENT) {
    throw UserError(fmt::format("{} is not installed, which circuits in Verilog need: apt-get install {}",
                                words[0], package));
  }
  if (failed != 0) throw UserError(fmt::format("cannot run {}: {}", words[0], std::strerror(failed)));
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  std::string said = content(log);
  if (status != 0)
    throw UserError(fmt::format("{}: {}", words[0], with_remedy(excerpt(complaint(said, error_word), 600))));
  return said;
}

// A pin as the header of Verilator's class declares it: VL_IN8(&clk,0,0), VL_OUTW(&q,351,0,11).
struct DeclaredPin {
  std::string name;
  bool is_input;
  unsigned width;
};

std::vector<DeclaredPin> pins_of(const std::string& header) {
  static const std::regex declaration(R"(VL_(IN|OUT|INOUT)(8|16|64|W)?\((\(?)&(\w+)(\)[^,]*)?,(\d+),(\d+))");
  std::vector<DeclaredPin> pins;
  for (auto at = std::sregex_iterator(header.begin(), header.end(), declaration);
       at != std::sregex_iterator(); ++at) {
    const std::smatch& match = *at;
    const std::string name = match[4];
    if (match[1] == "INOUT" || match[3] != "") {
      throw UserError(
          fmt::format("the circuit's pin {} is {}: pins are inputs and outputs of one dimension; "
                      "put a module around it",
                      name, match[1] == "INOUT" ? "an inout" : "an array"));
    }
    const unsigned high = static_cast<unsigned>(std::stoul(match[6]));
    const unsigned low = static_cast<unsigned>(std::stoul(match[7]));
    pins.push_back({name, match[1] == "IN", high - low + 1});
  }
  return pins;
}

// The one unit that is compiled: the circuit's C++, Verilator's library, and the interface. `prefix`: of
// Verilator's files and class, behind the V.
std::string unit(const fs::path& folder, const std::string& prefix, const std::string& top,
                 const std::vector<DeclaredPin>& pins) {
  std::string text = fmt::format(
      "#include \"V{0}.h\"\n#define PARALLAX_TOP V{0}\n#define PARALLAX_NAME \"{1}\"\n", prefix, top);
  text += fmt::format("#define PARALLAX_PIN_COUNT {}\n#define PARALLAX_PINS(TOP) \\\n", pins.size());
  for (const DeclaredPin& pin : pins) {
    text += fmt::format("  {{\"{0}\", {1}, {2}, &TOP.{0}}}, \\\n", pin.name, pin.is_input ? 1 : 0, pin.width);
  }
  text += "\n#include \"circuit.h\"\n#include \"verilated_circuit.hpp\"\n";
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() == ".cpp" && name.rfind("V" + prefix, 0) == 0) files.push_back(name);
  }
  std::sort(files.begin(), files.end());
  for (const std::string& file : files) text += fmt::format("#include \"{}\"\n", file);
  return text + "#include \"verilated.cpp\"\n#include \"verilated_threads.cpp\"\n";
}

// Where circuit.h and its neighbour lie, beside the program as presets do.
fs::path interface_folder() {
  std::error_code failed;
  const fs::path program = fs::read_symlink("/proc/self/exe", failed);
  const fs::path beside = program.parent_path() / "circuit";
  const fs::path installed = program.parent_path() / ".." / "share" / "parallax" / "circuit";
  for (const fs::path& folder : {beside, installed}) {
    if (fs::exists(folder / "circuit.h", failed)) return folder.lexically_normal();
  }
  throw UserError(fmt::format("circuit.h is neither in {} nor in {}: install parallax as a whole",
                              beside.string(), installed.lexically_normal().string()));
}

// Modules that no other one instantiates, of which Verilator would take all as one circuit.
void check_one_top(const std::string& said) {
  static const std::regex top("Top module '(\\w+)'");
  Words tops;
  for (auto at = std::sregex_iterator(said.begin(), said.end(), top); at != std::sregex_iterator(); ++at)
    tops.push_back((*at)[1]);
  if (tops.empty()) return;
  throw UserError(fmt::format("these modules can be the circuit: {}; --circuit-top NAME says which",
                              excerpt(fmt::format("{}", fmt::join(tops, ", ")), 400)));
}

void check_language(const fs::path& source) {
  if (source.extension() != ".vhd" && source.extension() != ".vhdl") return;
  throw UserError(fmt::format(
      "{} is VHDL; ghdl --synth --std=08 --out=verilog {} -e ENTITY > ENTITY.v makes Verilog of it",
      excerpt(source.string(), 300), excerpt(source.string(), 300)));
}

UserError cannot_write(const fs::path& library, const std::string& why) {
  return UserError(fmt::format("cannot write {}: {}", library.string(), why));
}

// Says so before what takes ten seconds.
void check_writable(const fs::path& library) {
  std::error_code ignored;
  const bool is_new = !fs::exists(library, ignored);
  if (!std::ofstream(library, std::ios::app)) throw cannot_write(library, std::strerror(errno));
  if (is_new) fs::remove(library, ignored);
}

// Verilator names its files V, --top-module or the first source's name, and what they are.
std::string prefix_in(const fs::path& folder) {
  constexpr std::string_view kRoot = "___024root.h";
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.size() > kRoot.size() + 1 && name.substr(name.size() - kRoot.size()) == kRoot)
      return name.substr(1, name.size() - kRoot.size() - 1);
  }
  throw UserError("Verilator has written no top module");
}

// Only Verilator's description of the circuit says which module is the top one: its first cell. Where it
// writes none, the prefix has to do.
std::string top_name(Words words, const fs::path& folder, const std::string& prefix) {
  const fs::path file = folder / "circuit.xml";
  *std::find(words.begin(), words.end(), "--cc") = "--xml-only";
  words.insert(words.end(), {"--xml-output", file.string()});
  try {
    run_tool(words, folder, "verilator", "%Error");
  } catch (const UserError&) {
    return prefix;
  }
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    static const std::regex cell("<cell [^>]*\\bname=\"(\\w+)\"");
    std::smatch match;
    if (line.find("<cell ") != std::string::npos && std::regex_search(line, match, cell)) return match[1];
  }
  return prefix;
}

// The pins with somewhere to lie.
void look_at(const std::vector<DeclaredPin>& pins, const std::string& top, const PinCheck& check) {
  PinList list{top, {}};
  std::vector<std::vector<std::uint64_t>> values;
  for (const DeclaredPin& pin : pins) {
    values.emplace_back((pin.width + 63) / 64);
    list.pins.push_back({pin.name.c_str(), pin.is_input ? 1u : 0u, pin.width, values.back().data()});
  }
  check(list);
}

void check_there(const fs::path& file) {
  if (!fs::is_regular_file(file)) throw UserError(fmt::format("{} is no file", excerpt(file.string(), 300)));
}

}  // namespace

void build_circuit(const std::vector<fs::path>& sources, const CircuitOptions& options,
                   const fs::path& library, const PinCheck& check) {
  std::for_each(sources.begin(), sources.end(), check_there);
  const fs::path interface = interface_folder();
  check_writable(library);
  BuildFolder folder;
  Words words{"verilator", "--cc",        "--no-timing", "-Wno-fatal", "--x-assign",
              "unique",    "--x-initial", "unique",      "--Mdir",     folder.path().string()};
  // Delay lines are often arrays that loops shift: Verilator unrolls those of 64 steps.
  words.insert(words.end(), {"--unroll-count", "8192", "--unroll-stmts", "100000"});
  if (!options.top.empty()) words.insert(words.end(), {"--top-module", options.top});
  for (const std::string& parameter : options.parameters) {
    const std::size_t equals = parameter.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == parameter.size()) {
      throw UserError(
          fmt::format("--circuit-parameter: '{}' is not NAME=VALUE, as WIDTH=640", excerpt(parameter)));
    }
    words.push_back("-G" + parameter);
  }
  for (const std::string& include : options.includes) {
    if (!fs::is_directory(include))
      throw UserError(fmt::format("--circuit-include: {} is no folder", excerpt(include, 300)));
    words.push_back("-I" + include);
  }
  for (const std::string& define : options.defines) {
    static const std::regex macro("[A-Za-z_]\\w*(=[^]*)?");
    if (!std::regex_match(define, macro)) {
      throw UserError(fmt::format("--circuit-define: '{}' is not NAME[=VALUE], as SIMULATION or WIDTH=640",
                                  excerpt(define)));
    }
    words.push_back("-D" + define);
  }
  for (const fs::path& source : sources) {
    check_language(source);
    words.push_back(source.string());
    if (const fs::path parent = source.parent_path(); !parent.empty())
      words.push_back("-I" + parent.string());
  }
  check_one_top(run_tool(words, folder.path(), "verilator", "%Error"));
  std::string root =
      run_tool({"verilator", "--getenv", "VERILATOR_ROOT"}, folder.path(), "verilator", "%Error");
  root.erase(root.find_last_not_of(" \n") + 1);
  const std::string prefix = prefix_in(folder.path());
  const std::vector<DeclaredPin> pins = pins_of(content(folder.path() / ("V" + prefix + ".h")));
  if (pins.empty())
    throw UserError(fmt::format("{}: the circuit's top module has no pins", sources[0].string()));
  const fs::path source = folder.path() / "circuit.cpp";
  const std::string top = top_name(words, folder.path(), prefix);
  if (check) look_at(pins, top, check);
  std::ofstream(source) << unit(folder.path(), prefix, top, pins);
  const fs::path made = folder.path() / "circuit.so";
  run_tool({"g++", "-std=c++17", "-shared", "-fPIC", "-O2", "-fvisibility=hidden", "-w", "-DVL_USER_FINISH",
            "-DVL_USER_STOP", "-DVL_USER_FATAL", "-I" + folder.path().string(), "-I" + interface.string(),
            "-I" + root + "/include", "-I" + root + "/include/vltstd", "-o", made.string(), source.string(),
            "-pthread"},
           folder.path(), "g++", "error");
  std::error_code failed;
  fs::copy_file(made, library, fs::copy_options::overwrite_existing, failed);
  if (failed) throw cannot_write(library, failed.message());
}

CircuitFile::CircuitFile(const std::vector<fs::path>& files, const CircuitOptions& options,
                         const PinCheck& check) {
  for (const fs::path& file : files) {
    if (!fs::is_regular_file(file))
      throw UserError(fmt::format("--circuit: {} is no file", excerpt(file.string(), 300)));
  }
  if (files.size() == 1 && files[0].extension() == ".so") {
    path_ = files[0];
    return;
  }
  BuildFolder folder;
  path_ = folder.path() / "circuit.so";
  build_circuit(files, options, path_, check);
  folder_ = folder.keep();
}

CircuitFile::~CircuitFile() {
  std::error_code ignored;
  if (!folder_.empty()) fs::remove_all(folder_, ignored);
}

}  // namespace parallax
