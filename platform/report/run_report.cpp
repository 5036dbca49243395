// SPDX-License-Identifier: Apache-2.0
#include "platform/report/run_report.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include "platform/files/plain_file.hpp"
#include "platform/results/result_schema.hpp"
#include "tlm/error.hpp"
#include "traces/json_text.hpp"

namespace parallax {
namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  require_plain_file(path.string(), "results of a run");
  std::ifstream in(path, std::ios::binary);
  constexpr std::size_t kMost = std::size_t{256} << 20;
  std::string text;
  std::vector<char> chunk(std::size_t{1} << 16);
  while (in.read(chunk.data(), static_cast<std::streamsize>(chunk.size())), in.gcount() > 0) {
    text.append(chunk.data(), static_cast<std::size_t>(in.gcount()));
    if (text.size() > kMost)
      throw UserError(
          fmt::format("{}: has more than {} MiB, no result has so many", path.string(), kMost >> 20));
  }
  if (!in.is_open() || in.bad())
    throw UserError(fmt::format("cannot read {}: {}", path.string(), std::generic_category().message(errno)));
  return text;
}

// No result is nested so deep, and what walks over one goes as deep.
nlohmann::ordered_json parse(const fs::path& file) {
  static constexpr int kDeepest = 32;
  const auto check = [&file](int depth, nlohmann::ordered_json::parse_event_t, nlohmann::ordered_json&) {
    if (depth <= kDeepest) return true;
    throw UserError(fmt::format("{}: damaged, it is nested more than {} deep; run parallax again",
                                file.string(), kDeepest));
  };
  return nlohmann::ordered_json::parse(read(file), check, false);
}

UserError damaged(const fs::path& file, const char* what) {
  return UserError(fmt::format("{}: damaged, {}; run parallax again", file.string(), excerpt(what, 200)));
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
                                file.string(), excerpt(json_text(version)), kResultSchema));
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
  const auto tree = parse(file);
  if (tree.is_discarded()) throw damaged(file, "this is no JSON");
  check_schema(file, tree);
  try {
    return report_in(file, tree);
  } catch (const MetricError& damage) {
    throw damaged(file, damage.what());
  } catch (const nlohmann::ordered_json::exception& damage) {
    throw damaged(file, damage.what());
  }
}

nlohmann::ordered_json read_result_json(const std::string& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return nullptr;
  auto tree = parse(path);
  if (tree.is_discarded() || !tree.is_object()) throw damaged(path, "this is no JSON");
  return tree;
}

}  // namespace parallax
