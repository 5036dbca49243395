// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/sweep_folder.hpp"

#include <fmt/format.h>

#include <fstream>

#include "tlm/error.hpp"
#include "traces/json_text.hpp"

namespace parallax {
namespace {

constexpr const char* kTiming = "timing.json";

std::string name_of(std::size_t point, const char* name) {
  return fmt::format("point_{:04}/{}", point, name);
}

}  // namespace

SweepFolder::SweepFolder(const std::filesystem::path& folder, const FolderPlan& plan, const std::string& text,
                         const std::vector<std::string>& names)
    : folder_(folder, plan), store_(folder / "results.db") {
  const std::vector<std::string> there = store_.specifications();
  for (const std::string& other : there) {
    if (other != text)
      throw UserError(
          fmt::format("{}: has the results of another sweep or exploration: {}; each has a folder of its own",
                      folder.string(), excerpt(other)));
  }
  begun_ = !there.empty();
  store_.begin(text, names);
}

bool SweepFolder::knows(std::size_t point, const PointIdentity& what) {
  const std::optional<KnownResult> known = store_.find(result_identity(what), {});
  if (!known || !store_.has(point, known->id)) return false;
  return !known->done || std::filesystem::exists(folder_.path() / name_of(point, kTiming));
}

std::optional<EvaluationResult> SweepFolder::result(std::size_t point) {
  const std::optional<StoredPoint> stored = store_.point(point, {});
  if (!stored) return std::nullopt;
  if (stored->result.status != name(EvaluationResult::Status::kDone)) {
    const auto status = status_named(stored->result.status);
    return status ? std::optional(not_measured(*status, stored->result.message)) : std::nullopt;
  }
  std::ifstream file(folder_.path() / name_of(point, kTiming));
  try {
    const auto tree = nlohmann::ordered_json::parse(file);
    EvaluationResult result = measured(metrics_of(tree));
    result.configuration = json_text(tree.at("configuration"));
    return result;
  } catch (const nlohmann::ordered_json::exception&) {
  } catch (const MetricError&) {
  }
  return std::nullopt;  // somebody has changed it
}

void SweepFolder::keep(std::size_t point, const std::vector<std::string>& values, const PointIdentity& what,
                       const EvaluationResult& result, const std::string& relaxations) {
  if (result.done()) {
    folder_.write(name_of(point, kTiming), json_text(timing_json(result), 2) + "\n");
    if (!relaxations.empty()) folder_.write(name_of(point, "relaxations.json"), relaxations);
    folder_.publish();
  }
  store_.add(stored_point({point, values}, what, result, {}));
}

}  // namespace parallax
