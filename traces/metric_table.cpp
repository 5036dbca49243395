// SPDX-License-Identifier: Apache-2.0
#include "traces/metric_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace parallax {
namespace {

// `text` with `replacement` where it has something in angle brackets.
std::string filled(const std::string& text, const std::string& replacement) {
  const std::size_t open = text.find('<');
  const std::size_t close = text.find('>', open);
  if (open == std::string::npos || close == std::string::npos) return text;
  return text.substr(0, open) + replacement + text.substr(close + 1);
}

}  // namespace

const MetricInfo& MetricTable::at(std::string_view path) const {
  const auto found =
      std::find_if(rows_.begin(), rows_.end(), [&](const MetricInfo& row) { return row.path == path; });
  if (found == rows_.end())
    throw std::logic_error(fmt::format("no row of the table of metrics in this file is {}", path));
  return *found;
}

MetricWriter MetricWriter::of(std::string name, std::string meaning) const {
  MetricWriter writer = *this;
  writer.name_ = std::move(name);
  writer.meaning_ = std::move(meaning);
  return writer;
}

MetricWriter MetricWriter::over(std::string window) const {
  MetricWriter writer = *this;
  writer.window_ = std::move(window);
  return writer;
}

void MetricWriter::add(std::string_view path, MetricValue value) const {
  const MetricInfo& info = table_.at(path);
  std::string rest = filled(info.path, name_);
  MetricGroup* group = &root_;
  for (std::size_t slash = rest.find('/'); slash != std::string::npos; slash = rest.find('/')) {
    group = &group->group(rest.substr(0, slash));
    rest.erase(0, slash + 1);
  }
  group->metrics.push_back({rest, std::move(value), info.unit, filled(info.description, meaning_),
                            info.window.empty() || window_.empty() ? info.window : window_});
}

}  // namespace parallax
