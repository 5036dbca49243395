// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/search_space.hpp"

#include <algorithm>

namespace parallax {
namespace {

std::vector<std::string> values_of(const Axis& axis) {
  if (!axis.span) return axis.values;
  const Span& span = *axis.span;
  const double numbers = span.most - span.least + 1;
  const bool each = span.whole && numbers <= static_cast<double>(SearchSpace::kSteps);
  // Of whole numbers, each has a part of the axis; a place in its middle is sure to lie in it.
  Axis even = axis;
  even.span->logarithmic = span.logarithmic && !each;
  const std::size_t steps = each ? static_cast<std::size_t>(numbers) : SearchSpace::kSteps;
  const bool parts = span.whole && !even.span->logarithmic;
  std::vector<std::string> values;
  for (std::size_t i = 0; i < steps; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(std::max<std::size_t>(steps - 1, 1));
    std::string value = value_at(even, parts ? (part * (numbers - 1) + 0.5) / numbers : part);
    if (values.empty() || values.back() != value) values.push_back(std::move(value));
  }
  return values;
}

}  // namespace

SearchSpace::SearchSpace(const std::vector<Axis>& axes) {
  for (const Axis& axis : axes) axes_.push_back(values_of(axis));
}

std::vector<std::size_t> SearchSpace::sizes() const {
  std::vector<std::size_t> sizes;
  for (const std::vector<std::string>& values : axes_) sizes.push_back(values.size());
  return sizes;
}

double SearchSpace::machines() const {
  double product = 1;
  for (const std::vector<std::string>& values : axes_) product *= static_cast<double>(values.size());
  return product;
}

std::vector<std::string> SearchSpace::values(const Place& place) const {
  std::vector<std::string> values;
  for (std::size_t i = 0; i < place.size(); ++i) values.push_back(axes_[i][place[i]]);
  return values;
}

}  // namespace parallax
