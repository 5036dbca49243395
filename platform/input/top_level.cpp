// SPDX-License-Identifier: Apache-2.0
#include "platform/input/top_level.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>

namespace parallax {
namespace {

std::string without_blanks(const std::string& text, const char* blanks) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

bool digits_only(const std::string& text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

}  // namespace

TopLevel::TopLevel(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  file_storage_ = text.compare(0, 5, "%YAML") == 0 || text.compare(0, 5, "<?xml") == 0 ||
                  (begin != std::string::npos && text[begin] == '{');
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == ' ' || line.front() == '\t' || line.front() == '#') continue;
    const std::size_t separator = line.find_first_of(":=");
    if (separator == std::string::npos) continue;
    values_.emplace(without_blanks(line.substr(0, separator), " \t\"'"),
                    without_blanks(line.substr(separator + 1), " \t\r"));
  }
}

std::string TopLevel::value(const std::string& name) const {
  const auto found = values_.find(name);
  return found == values_.end() ? "" : found->second;
}

std::vector<int> TopLevel::numbers(const std::string& beginning) const {
  constexpr std::size_t kMostDigits = 3;
  std::set<int> found;
  for (const auto& [name, value] : values_) {
    if (name.compare(0, beginning.size(), beginning) != 0) continue;
    const std::string rest = name.substr(beginning.size());
    if (digits_only(rest) && rest.size() <= kMostDigits) found.insert(std::stoi(rest));
  }
  return {found.begin(), found.end()};
}

bool TopLevel::has_number(const std::string& name) const {
  const std::string text = value(name);
  return !text.empty() && (std::isdigit(static_cast<unsigned char>(text.front())) != 0 ||
                           std::string("+-.").find(text.front()) != std::string::npos);
}

}  // namespace parallax
