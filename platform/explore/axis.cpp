// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace parallax {
namespace {

// A product of factors that should meet `most` may miss it by its last bits.
constexpr double kTolerance = 1e-9;

std::string number_value(double number, bool whole) {
  return whole ? fmt::format("{:.0f}", number) : fmt::format("{:.7g}", number);
}

double number_at(const Span& span, double place) {
  if (span.whole && !span.logarithmic) return span.least + std::floor(place * (span.most - span.least + 1));
  const double number = span.logarithmic ? span.least * std::pow(span.most / span.least, place)
                                         : span.least + place * (span.most - span.least);
  return span.whole ? std::round(number) : number;
}

}  // namespace

std::string value_at(const Axis& axis, double place) {
  if (axis.span) return number_value(number_at(*axis.span, place), axis.span->whole);
  const auto number = static_cast<double>(axis.values.size());
  const auto index = static_cast<std::size_t>(place * number);
  return axis.values[std::min(index, axis.values.size() - 1)];
}

std::vector<std::string> logarithmic_values(double least, double most, double factor, bool whole) {
  std::vector<std::string> values;
  for (double number = least; number <= most * (1 + kTolerance); number *= factor) {
    std::string value = number_value(number, whole);
    if (values.empty() || values.back() != value) values.push_back(std::move(value));
  }
  return values;
}

}  // namespace parallax
