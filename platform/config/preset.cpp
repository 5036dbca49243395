// SPDX-License-Identifier: Apache-2.0
#include "platform/config/preset.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <sstream>

#include "platform/config/nearest_name.hpp"
#include "platform/config/preset_file.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

namespace fs = std::filesystem;
using Folders = std::vector<fs::path>;

constexpr std::size_t kLongestChain = 64;

}  // namespace

bool is_preset_path(const std::string& name) {
  const std::string suffix = ".toml";
  const bool ends_so =
      name.size() >= suffix.size() && name.compare(name.size() - suffix.size(), suffix.size(), suffix) == 0;
  return ends_so || name.find('/') != std::string::npos;
}

namespace {

std::vector<std::string> names_in(const Folders& folders) {
  std::vector<std::string> names;
  for (const fs::path& folder : folders) {
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(folder, failed)) {
      if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    }
  }
  return names;
}

std::string joined(const Folders& folders) {
  std::string text;
  for (const fs::path& folder : folders) text += (text.empty() ? "" : ", ") + folder.string();
  return text.empty() ? "no folder" : text;
}

/// `before` opens the message: empty for the command line, "file:line: " for an `inherits`.
fs::path find_file(const std::string& name, const fs::path& relative_to, const Folders& folders,
                   const std::string& before, const std::string& what) {
  std::error_code ignored;
  if (is_preset_path(name)) {
    fs::path file = relative_to.empty() ? fs::path(name) : (relative_to / name).lexically_normal();
    if (fs::exists(file, ignored)) return file;
    throw UserError(fmt::format("{}{} file {} does not exist", before, what, excerpt(file.string(), 300)));
  }
  for (const fs::path& folder : folders) {
    fs::path file = folder / (name + ".toml");
    if (fs::exists(file, ignored)) return file;
  }
  const std::string nearest = nearest_name(name, names_in(folders));
  throw UserError(fmt::format("{}no {} '{}' in {}{}{}", before, what, excerpt(name), joined(folders),
                              nearest.empty() ? "" : "; the nearest is ", nearest));
}

/// `chain`: the inheriting file and those before it, to tell a cycle. Returns the file's layer.
int load(const fs::path& file, const Folders& folders, const std::string& what, std::vector<fs::path>& chain,
         RawConfig& values) {
  PresetFile preset = read_preset_file(file, what);
  chain.push_back(file);
  if (chain.size() > kLongestChain) {
    throw UserError(fmt::format("{}: inherits from more than {} presets one after another, from {} on",
                                file.string(), kLongestChain, chain.front().string()));
  }
  int layer = 0;
  if (preset.inherits) {
    // A family of presets in one folder finds its own members first.
    Folders around{file.has_parent_path() ? file.parent_path() : fs::path(".")};
    around.insert(around.end(), folders.begin(), folders.end());
    const fs::path parent =
        find_file(*preset.inherits, file.parent_path(), around, preset.inherits_origin + ": ", what);
    const auto same = [&](const fs::path& other) {
      std::error_code ignored;
      return fs::equivalent(other, parent, ignored);
    };
    if (std::any_of(chain.begin(), chain.end(), same)) {
      std::string cycle;
      for (const fs::path& link : chain) cycle += link.filename().string() + " -> ";
      throw UserError(fmt::format("{}: inherits goes round in a circle: {}{}", preset.inherits_origin, cycle,
                                  parent.filename().string()));
    }
    layer = load(parent, folders, what, chain, values) + 1;
  }
  for (auto& [key, value] : preset.values) {
    value.layer = layer;
    values[key] = std::move(value);
  }
  return layer;
}

// The program, or the shared library that holds this code; empty where it cannot be found.
fs::path own_file() {
  Dl_info ignored{};
  void* object = nullptr;
  const auto* const here = reinterpret_cast<const void*>(&own_file);
  if (::dladdr1(here, &ignored, &object, RTLD_DL_LINKMAP) != 0) {
    fs::path library = static_cast<const link_map*>(object)->l_name;
    if (!library.empty()) return library;
  }
  std::error_code failed;
  const fs::path program = fs::read_symlink("/proc/self/exe", failed);
  return failed ? fs::path() : program;
}

}  // namespace

std::vector<fs::path> preset_folders() {
  Folders folders;
  if (const char* path = std::getenv("PARALLAX_PRESET_PATH")) {
    std::istringstream list(path);
    for (std::string folder; std::getline(list, folder, ':');) {
      if (!folder.empty()) folders.emplace_back(folder);
    }
  }
  if (const fs::path program = own_file(); !program.empty()) {
    folders.push_back(program.parent_path() / "presets");
    folders.push_back((program.parent_path() / ".." / "share" / "parallax" / "presets").lexically_normal());
  }
  return folders;
}

fs::path find_toml(const std::string& name, const std::vector<fs::path>& folders, const std::string& what) {
  return find_file(name, {}, folders, "", what);
}

RawConfig load_preset(const std::string& name, const std::vector<fs::path>& folders,
                      const std::string& what) {
  RawConfig values;
  std::vector<fs::path> chain;
  load(find_file(name, {}, folders, "", what), folders, what, chain, values);
  return values;
}

std::vector<PresetSummary> list_presets(const std::vector<fs::path>& folders) {
  std::map<std::string, std::string> found;
  for (const fs::path& folder : folders) {
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(folder, failed)) {
      const fs::path& file = entry.path();
      if (file.extension() != ".toml" || found.count(file.stem().string())) continue;
      std::string description;
      try {
        description = read_preset_file(file).description;
      } catch (const UserError& error) {
        description = fmt::format("(not readable: {})", error.what());
      }
      found.emplace(file.stem().string(), description);
    }
  }
  std::vector<PresetSummary> presets;
  for (const auto& [name, description] : found) presets.push_back({name, description});
  return presets;
}

}  // namespace parallax
