// SPDX-License-Identifier: Apache-2.0
#include "platform/python/evaluated_points.hpp"

#include <algorithm>
#include <deque>
#include <utility>

#include "platform/config/preset.hpp"
#include "platform/evaluation/evaluation_inputs.hpp"
#include "platform/input/run_input.hpp"
#include "platform/python/process_start.hpp"
#include "platform/python/run_line.hpp"

namespace parallax {
namespace {

// Of each a map is kept, some megabytes.
constexpr std::size_t kKept = 4;

unsigned processes_for(std::size_t points, unsigned wanted) {
  if (wanted == 0) wanted = EvaluationPool::usual_processes();
  return static_cast<unsigned>(std::min<std::size_t>(wanted, points));
}

}  // namespace

std::vector<std::string> TimedPoint::words() const {
  std::vector<std::string> all = input;
  all.insert(all.end(), machine.begin(), machine.end());
  return all;
}

// Opened once for points that have the same.
class EvaluatedPoints::Inputs {
 public:
  EvaluationInputs& of(const std::vector<std::string>& words, const std::shared_ptr<RunOptions>& options) {
    const auto found = std::find_if(opened_.begin(), opened_.end(),
                                    [&](const auto& opened) { return opened->words == words; });
    if (found != opened_.end()) return (*found)->inputs;
    if (opened_.size() == kKept) opened_.pop_front();
    opened_.push_back(std::make_unique<Opened>(words, options));
    return opened_.back()->inputs;
  }

 private:
  struct Opened {
    Opened(std::vector<std::string> input_words, std::shared_ptr<RunOptions> point_options)
        : words(std::move(input_words)), options(std::move(point_options)), inputs(*options) {}
    std::vector<std::string> words;
    std::shared_ptr<RunOptions> options;
    EvaluationInputs inputs;
  };

  std::deque<std::unique_ptr<Opened>> opened_;
};

EvaluatedPoints::EvaluatedPoints(std::vector<TimedPoint> points, unsigned processes)
    : points_(std::move(points)),
      inputs_(std::make_unique<Inputs>()),
      pool_([this](const Variant& variant,
                   const NoticeSink& notice) { return prepare(points_[variant.base], notice); },
            processes_for(points_.size(), processes)) {}

EvaluatedPoints::~EvaluatedPoints() = default;

EvaluationCase EvaluatedPoints::prepare(const TimedPoint& point, const NoticeSink& notice) {
  prepare_process();
  const std::shared_ptr<RunOptions> options = run_options(point.words());
  check_options(*options);
  EvaluationCase one{load_configuration(options->configuration, preset_folders()), {}};
  one.input = inputs_->of(point.input, options).prepare(one.configuration.machine, notice);
  one.input.command = run_line(point.words()).text();
  return one;
}

bool EvaluatedPoints::evaluate(const std::function<bool()>& interrupted, const EvaluationPool::Taker& take) {
  std::vector<Variant> variants;
  for (std::size_t i = 0; i < points_.size(); ++i) variants.push_back({{}, i});
  return pool_.evaluate(variants, interrupted, take) == points_.size();
}

}  // namespace parallax
