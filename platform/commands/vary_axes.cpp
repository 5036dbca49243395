// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/vary_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <utility>

#include "platform/config/nearest_key.hpp"
#include "platform/explore/value_range.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr std::size_t kMostPoints = 100'000;

void set_disparities(RunOptions& options, const std::string& value) {
  std::int64_t range = 0;
  const char* const end = value.data() + value.size();
  const auto [last, error] = std::from_chars(value.data(), end, range);
  if (error != std::errc() || last != end)
    throw UserError(fmt::format("--disparities: '{}' is not a whole number", excerpt(value)));
  options.configuration.disparity_range = range;
}

const std::vector<VariedOption>& varied_options() {
  using Options = RunOptions;
  using Text = std::string;
  static const std::vector<VariedOption> all{
      {"size", [](const Options& o) { return !o.size.empty(); },
       [](Options& o, const Text& value) { o.size = value; }},
      {"preset", [](const Options& o) { return o.configuration.preset != ConfigurationRequest{}.preset; },
       [](Options& o, const Text& value) { o.configuration.preset = value; }},
      {"disparities", [](const Options& o) { return o.configuration.disparity_range.has_value(); },
       set_disparities},
      {"input", [](const Options& o) { return !o.input.empty(); },
       [](Options& o, const Text& value) { o.input = value; }},
      {"calibration", [](const Options& o) { return !o.calibration.empty(); },
       [](Options& o, const Text& value) { o.calibration = {value}; }},
      {"map", [](const Options& o) { return !o.map.empty(); },
       [](Options& o, const Text& value) { o.map = value; }}};
  return all;
}

// At the commas, but not within double quotes: a set of names has commas of its own.
std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  bool quoted = false;
  for (const char c : text) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

// An option's value has no quotes around it.
std::string unquoted(const std::string& text) {
  const bool quoted = text.size() > 2 && text.front() == '"' && text.back() == '"';
  return quoted ? text.substr(1, text.size() - 2) : text;
}

// Each range becomes its numbers.
std::vector<std::string> expanded(const std::vector<std::string>& written) {
  std::vector<std::string> values;
  for (const std::string& value : written) {
    if (value.find(':') == std::string::npos) {
      values.push_back(value);
    } else {
      for (std::string& number : range_values(value, kMostPoints)) values.push_back(std::move(number));
    }
  }
  return values;
}

VaryAxis read_axis(const std::string& argument, const Schema& schema, const RunOptions& options) {
  const std::string before = fmt::format("--vary {}: ", excerpt(argument));
  const std::size_t equals = std::min(argument.find('='), argument.size());
  VaryAxis axis{argument.substr(0, equals), split(argument.substr(std::min(equals + 1, argument.size())))};
  const bool blank =
      std::any_of(axis.values.begin(), axis.values.end(), [](const std::string& v) { return v.empty(); });
  if (axis.name.empty() || blank) throw UserError(before + "must have the form key=value,value,...");
  for (const VariedOption& option : varied_options()) {
    if (axis.name == option.name) axis.option = &option;
  }
  const Key* const key = axis.option == nullptr ? schema.find(axis.name) : nullptr;
  if (axis.option == nullptr && key == nullptr) {
    std::vector<std::string> names;
    for (const Key& known : schema.keys()) names.push_back(known.path);
    for (const VariedOption& option : varied_options()) names.emplace_back(option.name);
    throw UserError(fmt::format("{}unknown key {}; the nearest is {}", before, excerpt(axis.name),
                                nearest_key(axis.name, names)));
  }
  if (axis.option != nullptr && axis.option->given(options)) {
    throw UserError(fmt::format("--vary {0} and --{0} exclude each other", axis.name));
  }
  const bool numbers = key != nullptr ? key->type == KeyType::kInteger || key->type == KeyType::kReal
                                      : axis.option->set == set_disparities;
  try {
    if (numbers) axis.values = expanded(axis.values);
  } catch (const UserError& error) {
    throw UserError(before + error.what());
  }
  if (axis.option != nullptr)
    std::transform(axis.values.begin(), axis.values.end(), axis.values.begin(), unquoted);
  return axis;
}

}  // namespace

VaryGrid::VaryGrid(const RunOptions& options) {
  MachineConfig machine;
  Schema schema;
  describe(schema, machine);
  for (const std::string& argument : options.vary) {
    VaryAxis axis = read_axis(argument, schema, options);
    if (varies(axis.name))
      throw UserError(fmt::format("--vary {}: {} is varied twice", excerpt(argument), axis.name));
    size_ *= axis.values.size();
    if (size_ > kMostPoints) throw UserError(fmt::format("--vary: more than {} combinations", kMostPoints));
    axes_.push_back(std::move(axis));
  }
  if (varies("matching.iterations") && (options.configuration.disparity_range || varies("disparities")))
    throw UserError("--vary matching.iterations and --disparities exclude each other: both set the range");
}

bool VaryGrid::varies(const std::string& name) const {
  return std::any_of(axes_.begin(), axes_.end(), [&](const VaryAxis& axis) { return axis.name == name; });
}

const std::string& VaryGrid::value(std::size_t point, std::size_t axis) const {
  for (std::size_t later = axes_.size() - 1; later > axis; --later) point /= axes_[later].values.size();
  return axes_[axis].values[point % axes_[axis].values.size()];
}

std::vector<std::string> VaryGrid::assignments(std::size_t point) const {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (axes_[i].option == nullptr) all.push_back(axes_[i].name + "=" + value(point, i));
  }
  return all;
}

std::vector<std::string> VaryGrid::option_values(std::size_t point) const {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (axes_[i].option != nullptr) all.push_back(value(point, i));
  }
  return all;
}

RunOptions VaryGrid::options(const RunOptions& options, std::size_t point) const {
  RunOptions varied = options;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (axes_[i].option != nullptr) axes_[i].option->set(varied, value(point, i));
  }
  const std::vector<std::string> more = assignments(point);
  std::vector<std::string>& all = varied.configuration.assignments;
  all.insert(all.end(), more.begin(), more.end());
  return varied;
}

std::vector<std::string> VaryGrid::words(std::size_t point) const {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const VaryAxis& axis = axes_[i];
    if (axis.option == nullptr) {
      all.insert(all.end(), {"--set", axis.name + "=" + value(point, i)});
    } else {
      all.insert(all.end(), {std::string("--") + axis.name, value(point, i)});
    }
  }
  return all;
}

std::vector<std::size_t> VaryGrid::firsts_of_options() const {
  std::vector<std::size_t> firsts;
  std::set<std::vector<std::string>> seen;
  for (std::size_t point = 0; point < size_; ++point) {
    if (seen.insert(option_values(point)).second) firsts.push_back(point);
  }
  return firsts;
}

}  // namespace parallax
