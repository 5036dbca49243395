// SPDX-License-Identifier: Apache-2.0
#include "platform/report/run_report.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

#include "platform/results/version.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in)
    throw UserError(fmt::format("cannot read {}: {}", path.string(), std::generic_category().message(errno)));
  return text;
}

}  // namespace

RunReport read_run_report(const std::string& path) {
  std::error_code error;
  fs::path file = path;
  if (fs::is_directory(file, error)) {
    file /= "timing.json";
    if (!fs::exists(file, error)) {
      throw UserError(
          fmt::format("{}: holds no timing.json, so no results of a run that came to its end", path));
    }
  } else if (!fs::exists(file, error)) {
    throw UserError(fmt::format("{}: no such file or folder", path));
  }
  RunReport report{file.string(), nlohmann::ordered_json::parse(read(file), nullptr, false)};
  const auto& tree = report.tree;
  if (tree.is_discarded()) {
    throw UserError(fmt::format("{}: damaged, this is no JSON; run parallax again", report.path));
  }
  const nlohmann::ordered_json::json_pointer version_path("/run/version/value");
  if (!tree.is_object() || !tree.contains(version_path) || !tree.at(version_path).is_string()) {
    throw UserError(fmt::format("{}: no timing.json of parallax, it has no run/version", report.path));
  }
  if (const std::string by = tree.at(version_path); by != version()) {
    throw UserError(
        fmt::format("{}: written by version {}, this is {}; run it again", report.path, by, version()));
  }
  // A stuck machine reached no frame rate.
  const bool stuck = tree.contains("deadlock");
  const std::vector<const char*> groups =
      stuck ? std::vector<const char*>{"input", "deadlock", "stages", "streams", "configuration"}
            : std::vector<const char*>{"input",  "performance", "latency", "memory",
                                       "stages", "streams",     "energy",  "configuration"};
  for (const char* group : groups) {
    if (tree.contains(group) && tree.at(group).is_object()) continue;
    throw UserError(fmt::format("{}: damaged, it has no {}; run parallax again", report.path, group));
  }
  return report;
}

nlohmann::ordered_json read_result_json(const std::string& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return nullptr;
  auto tree = nlohmann::ordered_json::parse(read(path), nullptr, false);
  if (tree.is_discarded() || !tree.is_object())
    throw UserError(fmt::format("{}: damaged, this is no JSON; run parallax again", path));
  return tree;
}

}  // namespace parallax
