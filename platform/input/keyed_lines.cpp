// SPDX-License-Identifier: Apache-2.0
#include "platform/input/keyed_lines.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <sstream>

#include "platform/input/number_text.hpp"
#include "platform/input/quoted_text.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

std::string word_of(const std::string& text) {
  std::string word;
  std::istringstream(text) >> word;
  return word;
}

}  // namespace

KeyedLines::KeyedLines(const CalibrationRequest::File& file, char separator) : where_(file.path + ": ") {
  std::istringstream lines(file.text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t end = line.find(separator);
    if (end == std::string::npos) continue;
    std::string value = line.substr(end + 1);
    for (char& c : value) {
      if (std::string("[],;\r\t").find(c) != std::string::npos) c = ' ';
    }
    values_[word_of(line.substr(0, end))].push_back(value);
  }
}

std::vector<double> KeyedLines::numbers(const std::string& name, std::size_t count) const {
  const auto found = values_.find(name);
  if (found == values_.end()) throw UserError(where(name) + " is missing");
  for (const std::string& other : found->second) {
    if (other != found->second.front()) throw UserError(where(name) + " occurs twice, with other numbers");
  }
  std::vector<double> numbers;
  std::istringstream words(found->second.front());
  for (std::string word; words >> word;) {
    const std::optional<double> value = number_of(word);
    if (!value) throw UserError(fmt::format("{}: {} is not a number", where(name), in_quotes(word)));
    if (!std::isfinite(*value)) throw UserError(where(name) + " holds a value that is not a finite number");
    numbers.push_back(*value);
  }
  if (numbers.size() != count) {
    throw UserError(fmt::format("{} has {} numbers, {} expected", where(name), numbers.size(), count));
  }
  return numbers;
}

}  // namespace parallax
