// SPDX-License-Identifier: Apache-2.0
#include "platform/config/disparity_filter.hpp"

namespace parallax {

DisparityFilters::DisparityFilters(const DisparityFilters& other) {
  for (const auto& filter : other.filters_) add(filter->clone());
}

DisparityFilters& DisparityFilters::add(std::unique_ptr<DisparityFilter> filter) {
  filters_.push_back(std::move(filter));
  return *this;
}

std::vector<std::string> DisparityFilters::streams() const {
  std::vector<std::string> names;
  for (const auto& filter : filters_) names.push_back(filter->stream());
  return names;
}

}  // namespace parallax
