// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/explorer.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "platform/explore/merit.hpp"
#include "platform/explore/point_rules.hpp"
#include "platform/explore/search.hpp"
#include "platform/explore/search_space.hpp"
#include "platform/results/result_schema.hpp"
#include "platform/results/version.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

// Handed to the pool at a time: enough that its processes seldom wait for the last of them.
constexpr std::size_t kAtATime = 512;

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

// All but the result.
StoredPoint identified(const ExplorationPoint& point, const PointIdentity& what) {
  StoredPoint next{point.number, point.values, {}};
  StoredResult& result = next.result;
  result.schema = kResultSchema;
  result.revision = revision();
  result.host = host_name();
  result.identity = result_identity(what);
  result.configuration = what.configuration;
  result.input = what.input;
  result.command = what.command;
  result.seed = what.seed;
  return next;
}

StoredValue stored(const Metric* metric) {
  if (metric == nullptr) return {};
  if (metric->is_number()) {
    const double number = metric->number();
    return std::isfinite(number) ? StoredValue(number) : StoredValue();
  }
  if (const auto* truth = std::get_if<bool>(&metric->value)) return *truth ? 1.0 : 0.0;
  if (const auto* word = std::get_if<std::string>(&metric->value)) return *word;
  return {};
}

void set_result(StoredResult& kept, const EvaluationResult& result, const std::vector<std::string>& metrics) {
  kept.status = name(result.status);
  kept.message = result.message;
  kept.limit = result.done() ? result.limit.part : "";
  kept.wall_seconds = result.wall_seconds;
  kept.processor_seconds = result.processor_seconds;
  if (!result.done()) return;
  for (const std::string& name : metrics) kept.metrics[name] = stored(result.metrics.find(name));
}

}  // namespace

// Results of another build of the program are others.
std::string result_identity(const PointIdentity& what) {
  return fmt::format("{} {} {} {}", what.configuration, version(), revision(), what.input);
}

StoredPoint stored_point(const ExplorationPoint& point, const PointIdentity& what,
                         const EvaluationResult& result, const std::vector<std::string>& metrics) {
  StoredPoint stored = identified(point, what);
  set_result(stored.result, result, metrics);
  return stored;
}

std::vector<std::string> kept_metrics(const ExplorationSpec& spec) {
  std::vector<std::string> names = spec.named_metrics();
  for (const char* usual :
       {"performance/frame_rate", "latency/exposure_to_host_mean", "latency/exposure_to_host_p99",
        "limit/utilisation", "memory/share", "energy/frame_total"}) {
    if (std::find(names.begin(), names.end(), usual) == names.end()) names.emplace_back(usual);
  }
  return names;
}

Explorer::Explorer(const ExplorationSpec& spec, ResultStore& store, EvaluationPool* pool, Identify identify,
                   PointShare share)
    : spec_(spec),
      store_(store),
      pool_(pool),
      identify_(std::move(identify)),
      share_(share),
      metrics_(kept_metrics(spec)) {}

ExplorationCounts Explorer::run(const std::function<bool()>& interrupted, const Advance& advance) {
  interrupted_ = interrupted;
  advance_ = advance;
  counts_.whole = spec_.sampling.method == SamplingMethod::kSearch ? search_for_best() : look_at_all();
  return counts_;
}

// Whether none is missing.
bool Explorer::look_at_all() {
  PointSource points(spec_);
  std::size_t seen = 0;
  while (!interrupted_()) {
    const std::optional<ExplorationPoint> point = points.next();
    if (point && !share_.has(point->number)) continue;
    if (point) {
      look_at(*point);
      ++seen;
    }
    if (!point || waiting_.size() == kAtATime) evaluate();
    if (!point) return counts_.points == seen;
  }
  return false;
}

// Points have their numbers in the order in which the search wants them, which is the same each time.
bool Explorer::search_for_best() {
  const SearchSpace space(spec_.axes);
  PointRules rules(spec_);
  std::size_t number = 0;
  const auto evaluate_places = [&](const std::vector<Place>& places) {
    std::vector<std::optional<std::size_t>> numbers;
    for (const Place& place : places) {
      std::vector<std::string> values = space.values(place);
      if (!rules.complete(values)) {
        numbers.emplace_back();
        continue;
      }
      look_at({number, std::move(values)});
      numbers.emplace_back(number++);
    }
    evaluate();
    std::vector<Merit> merits;
    for (const std::optional<std::size_t>& known : numbers) {
      if (!known) {
        merits.emplace_back();
        continue;
      }
      const std::optional<StoredPoint> point = store_.point(*known, metrics_);
      if (!point || interrupted_()) break;
      merits.push_back(merit_of(spec_, *point));
    }
    return merits;
  };
  return search({space.sizes(), spec_.sampling.points, spec_.sampling.seed}, evaluate_places) !=
         SearchEnd::kInterrupted;
}

void Explorer::look_at(const ExplorationPoint& point) {
  StoredPoint next;
  try {
    next = identified(point, identify_(point));
  } catch (const UserError& error) {
    next = identified(point, {});
    StoredResult& result = next.result;
    result.status = name(EvaluationResult::Status::kInvalid);
    result.message = error.what();
    result.identity.clear();
    for (const std::string& value : point.values) result.identity += value + " ";
    result.identity += fmt::format("{} {}: {}", version(), revision(), result.message);
  }
  if (stands(next)) return;
  if (!next.result.status.empty()) {
    keep(next);
    return;
  }
  const bool twin = std::any_of(waiting_.begin(), waiting_.end(), [&](const StoredPoint& other) {
    return other.result.identity == next.result.identity;
  });
  (twin ? twins_ : waiting_).push_back(std::move(next));
}

void Explorer::keep(const StoredPoint& point) {
  store_.add(point);
  ++counts_.points;
  if (point.result.status != name(EvaluationResult::Status::kDone)) ++counts_.not_done;
  advance_(1);
}

// Whether its result is known; then the point is there too.
bool Explorer::stands(const StoredPoint& point) {
  const std::optional<KnownResult> known = store_.find(point.result.identity, metrics_);
  if (!known) return false;
  if (!store_.has(point.number, known->id)) store_.add(point.number, point.values, known->id);
  ++counts_.points;
  if (!known->done) ++counts_.not_done;
  advance_(1);
  return true;
}

void Explorer::evaluate() {
  if (pool_ == nullptr) {
    waiting_.clear();
    twins_.clear();
    return;
  }
  std::vector<Variant> variants;
  for (const StoredPoint& point : waiting_) variants.push_back({point.values, 0});
  pool_->evaluate(
      variants, interrupted_,
      [this](std::size_t number, const EvaluationResult& result) { take(waiting_[number], result); },
      EvaluationPool::Order::kOfResults);
  const std::vector<StoredPoint> evaluated = std::exchange(waiting_, {});
  for (StoredPoint& twin : std::exchange(twins_, {})) {
    const auto same = std::find_if(evaluated.begin(), evaluated.end(), [&twin](const StoredPoint& one) {
      return one.result.identity == twin.result.identity;
    });
    // Without a status: interrupted before it was evaluated.
    if (same->result.status.empty()) continue;
    twin.result = same->result;
    keep(twin);
  }
}

void Explorer::take(StoredPoint& point, const EvaluationResult& result) {
  set_result(point.result, result, metrics_);
  ++counts_.evaluated;
  keep(point);
}

}  // namespace parallax
