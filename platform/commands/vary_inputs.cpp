// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/vary_inputs.hpp"

#include <algorithm>
#include <optional>

#include "platform/config/preset.hpp"
#include "platform/input/run_input.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

// Of each a map is kept, some megabytes.
constexpr std::size_t kKept = 4;
// So many inputs that cannot be opened are all.
constexpr std::size_t kTried = 100;

}  // namespace

EvaluationInputs& VaryInputs::inputs_of(std::size_t point) {
  const std::vector<std::string> values = grid_.option_values(point);
  const auto found = std::find_if(opened_.begin(), opened_.end(),
                                  [&](const auto& opened) { return opened->values == values; });
  if (found != opened_.end()) return (*found)->inputs;
  if (opened_.size() == kKept) opened_.pop_front();
  opened_.push_back(std::make_unique<Opened>(values, grid_.options(options_, point)));
  return opened_.back()->inputs;
}

Configuration VaryInputs::configuration(std::size_t point, const std::vector<std::string>& changes) const {
  ConfigurationRequest request = grid_.options(options_, point).configuration;
  request.changes = changes;
  return load_configuration(request, preset_folders());
}

EvaluationCase VaryInputs::prepare(std::size_t point, const std::vector<std::string>& changes,
                                   const NoticeSink& notice) {
  EvaluationCase one{configuration(point, changes), {}};
  one.input = inputs_of(point).prepare(one.configuration.machine, notice);
  return one;
}

void VaryInputs::open(const NoticeSink& notice) {
  std::vector<std::size_t> points = grid_.firsts_of_options();
  points.resize(std::min(points.size(), kTried));
  std::optional<UserError> first;
  for (const std::size_t point : points) {
    try {
      check_options(grid_.options(options_, point));
      // Without the keys that vary: what they bring about is their points' business.
      ConfigurationRequest request = grid_.options(options_, point).configuration;
      request.assignments = options_.configuration.assignments;
      inputs_of(point).open(load_configuration(request, preset_folders()).machine, notice);
      return;
    } catch (const UserError& error) {
      if (!first) first = error;
    }
  }
  throw UserError(*first);
}

}  // namespace parallax
