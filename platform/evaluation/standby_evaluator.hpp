// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "platform/config/configuration.hpp"
#include "platform/evaluation/forked_workers.hpp"
#include "platform/evaluation/timing_evaluator.hpp"

namespace parallax {

/// Times variants of a machine on one input, also when this process has simulated: processes that were made
/// before stand by, as many as this computer has processors for.
class StandbyEvaluator {
 public:
  /// What `input` points to must be there now. `configuration`: the machine that the variants are of.
  StandbyEvaluator(const TimingInput& input, const ConfigurationRequest& configuration);

  /// The results of variants, each with further "key=value". See ForkedWorkers::answer().
  std::vector<TimingResult> evaluate(const std::vector<std::vector<std::string>>& variants,
                                     const std::function<bool()>& interrupted,
                                     const std::function<void()>& done);

 private:
  ForkedWorkers workers_;
};

}  // namespace parallax
