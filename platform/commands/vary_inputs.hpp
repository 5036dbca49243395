// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "platform/commands/vary_axes.hpp"
#include "platform/evaluation/evaluation_inputs.hpp"
#include "platform/evaluation/evaluation_pool.hpp"

namespace parallax {

/// The machines and inputs of a grid's points: opened once for each combination of options, of which the last
/// few are kept.
class VaryInputs {
 public:
  /// Both must outlive this object.
  VaryInputs(const RunOptions& options, const VaryGrid& grid) : options_(options), grid_(grid) {}

  /// Checks the options and opens one input. What is wrong with all of them is one error, not one a point:
  /// throws it as UserError.
  void open(const NoticeSink& notice);
  /// A point, with further keys set. Throws UserError. The result points into this object, until the next
  /// call.
  EvaluationCase prepare(std::size_t point, const std::vector<std::string>& changes,
                         const NoticeSink& notice);
  Configuration configuration(std::size_t point, const std::vector<std::string>& changes) const;

 private:
  struct Opened {
    Opened(std::vector<std::string> chosen, RunOptions point_options)
        : values(std::move(chosen)), options(std::move(point_options)), inputs(options) {}
    std::vector<std::string> values;  // of the axes that are options
    RunOptions options;
    EvaluationInputs inputs;
  };

  EvaluationInputs& inputs_of(std::size_t point);

  const RunOptions& options_;
  const VaryGrid& grid_;
  std::deque<std::unique_ptr<Opened>> opened_;
};

}  // namespace parallax
