// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/standby_evaluator.hpp"

#include <algorithm>
#include <exception>
#include <thread>

#include "platform/config/preset.hpp"

namespace parallax {
namespace {

constexpr unsigned kMostWorkers = 8;

std::string evaluate_one(const TimingInput& input, ConfigurationRequest configuration,
                         const std::string& request) {
  TimingResult result;
  try {
    const auto assignments = nlohmann::ordered_json::parse(request).get<std::vector<std::string>>();
    configuration.assignments.insert(configuration.assignments.end(), assignments.begin(), assignments.end());
    result = TimingEvaluator(input).evaluate(load_configuration(configuration, preset_folders()).machine);
  } catch (const std::exception& error) {
    result.status = TimingResult::Status::kInvalid;
    result.message = error.what();
  }
  return to_json(result).dump();
}

}  // namespace

StandbyEvaluator::StandbyEvaluator(const TimingInput& input, const ConfigurationRequest& configuration)
    : workers_(std::clamp(std::thread::hardware_concurrency(), 1U, kMostWorkers),
               [input, configuration](const std::string& request) {
                 return evaluate_one(input, configuration, request);
               }) {}

std::vector<TimingResult> StandbyEvaluator::evaluate(const std::vector<std::vector<std::string>>& variants,
                                                     const std::function<bool()>& interrupted,
                                                     const std::function<void()>& done) {
  std::vector<std::string> requests;
  for (const std::vector<std::string>& variant : variants)
    requests.push_back(nlohmann::ordered_json(variant).dump());
  std::vector<TimingResult> results;
  for (const std::string& answer : workers_.answer(requests, interrupted, done)) {
    results.push_back(timing_result(nlohmann::ordered_json::parse(answer, nullptr, false)));
  }
  return results;
}

}  // namespace parallax
