// SPDX-License-Identifier: Apache-2.0
#include "platform/report/run_report.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "platform/results/result_schema.hpp"
#include "tlm/error.hpp"
#include "traces/json_text.hpp"

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

UserError damaged(const fs::path& file, const char* what) {
  return UserError(fmt::format("{}: damaged, {}; run parallax again", file.string(), what));
}

void check_schema(const fs::path& file, const nlohmann::ordered_json& tree) {
  const nlohmann::ordered_json::json_pointer schema("/schema/version/value"), program("/run/version/value");
  if (!tree.is_object() || !tree.contains(program))
    throw UserError(fmt::format("{}: no timing.json of parallax, it has no run/version", file.string()));
  if (!tree.contains(schema)) {
    throw UserError(
        fmt::format("{}: has no schema/version, an older parallax wrote it; run it again", file.string()));
  }
  if (const auto& version = tree.at(schema); version != kResultSchema) {
    throw UserError(fmt::format("{}: its schema/version is {}, this parallax reads {}; run it again",
                                file.string(), json_text(version), kResultSchema));
  }
}

RunReport report_in(const fs::path& file, nlohmann::ordered_json tree) {
  RunReport report{file.string(), {}, nlohmann::ordered_json::object()};
  const auto configuration = tree.find("configuration");
  if (configuration == tree.end() || !configuration->is_object())
    throw MetricError("it has no configuration");
  report.configuration = std::move(*configuration);
  tree.erase(configuration);
  report.metrics = metrics_of(tree);
  // A stuck machine reached no frame rate.
  const bool stuck = report.metrics.find_group("deadlock") != nullptr;
  for (const char* group : {"input", "stages", "streams"}) report.metrics.group_at(group);
  if (stuck) return report;
  for (const char* group : {"performance", "latency", "memory", "energy"}) report.metrics.group_at(group);
  return report;
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
  const auto tree = nlohmann::ordered_json::parse(read(file), nullptr, false);
  if (tree.is_discarded()) throw damaged(file, "this is no JSON");
  check_schema(file, tree);
  try {
    return report_in(file, tree);
  } catch (const MetricError& damage) {
    throw damaged(file, damage.what());
  }
}

nlohmann::ordered_json read_result_json(const std::string& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return nullptr;
  auto tree = nlohmann::ordered_json::parse(read(path), nullptr, false);
  if (tree.is_discarded() || !tree.is_object()) throw damaged(path, "this is no JSON");
  return tree;
}

}  // namespace parallax
