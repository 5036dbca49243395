// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "platform/commands/case_estimate.hpp"
#include "platform/evaluation/evaluation_inputs.hpp"
#include "platform/explore/explorer.hpp"

namespace parallax {

/// The machines and inputs of an exploration's points: inputs are opened once for each combination of
/// options, of which the last few are kept.
class ExplorationInputs {
 public:
  /// `spec` must outlive this object. Throws UserError: no such device.
  explicit ExplorationInputs(const ExplorationSpec& spec);

  /// Throws UserError where a point is no possible machine.
  PointIdentity identify(const ExplorationPoint& point);
  /// Likewise, or has no possible input. The result points into this object, until the next call.
  EvaluationCase prepare(const ExplorationPoint& point, const NoticeSink& notice);
  /// Checks the options and the input of a point, whatever its keys are. Throws UserError.
  void check_input(const ExplorationPoint& point);
  /// Of a point, those that are options.
  std::vector<RunWord> words(const ExplorationPoint& point) const;

 private:
  struct Opened {
    Opened(std::vector<std::string> chosen, RunOptions given)
        : words(std::move(chosen)), options(std::move(given)), inputs(options) {}
    std::vector<std::string> words;
    RunOptions options;
    EvaluationInputs inputs;
    std::string content{};  // of the files that it names
  };

  Opened& opened(const ExplorationPoint& point);
  RunOptions options(const ExplorationPoint& point) const;
  Configuration configuration(const RunOptions& options, const ExplorationPoint& point) const;
  std::string command(const ExplorationPoint& point) const;

  const ExplorationSpec& spec_;
  const CaseEstimate estimate_;
  std::deque<std::unique_ptr<Opened>> opened_;
};

}  // namespace parallax
