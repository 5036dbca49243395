// SPDX-License-Identifier: Apache-2.0
// What a line that is printed must be, as a pattern that names the metric of each number.
//
//   {path}        a metric of a JSON tree as it must be printed, with its unit: {memory/share}; a word as it
//   is {path#unit}   the same without its unit, which stands in a heading and must be this one
//   {=name}       what follows from several metrics, by a function of this name
//   <name>        a word, such as a port's; where a path has <name>, it is that word
//   <name...>     any words without a digit; <name..> any text without a blank
//   |             the bar of a part's time, which may be blank; between two fields
//
// Blanks are as many as one. A number of the line that is in none of these is in the pattern's own words.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "tests/traces/naive_number_text.hpp"

namespace parallax::test {

using Json = nlohmann::ordered_json;
/// Texts that follow from several metrics, by name.
using Derived = std::map<std::string, std::function<std::string(const Json&)>>;

inline const Json* entry_at(const Json& tree, const std::string& path) {
  const Json::json_pointer pointer("/" + path);
  if (!tree.contains(pointer) || !tree.at(pointer).contains("value")) return nullptr;
  return &tree.at(pointer);
}

/// A metric as it must be printed, without its unit.
inline std::string expected_text(const Json& entry) {
  const Json& value = entry.at("value");
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return naive_number_text(value.get<double>(), entry.at("unit"));
  return value.dump();
}

inline std::string expected_unit(const Json& entry) {
  const std::string unit = entry.at("unit");
  return unit == "frames/s" ? "fps" : unit;
}

inline std::string expected_with_unit(const Json& entry) {
  const std::string unit = expected_unit(entry);
  return expected_text(entry) + (unit.empty() ? "" : unit == "1/s" ? "/s" : " " + unit);
}

inline std::string with_single_blanks(const std::string& text) {
  return std::regex_replace(std::regex_replace(text, std::regex("\\s+"), " "), std::regex("^ | $"), "");
}

/// A pattern as above.
class PrintedLine {
 public:
  explicit PrintedLine(std::string pattern) : pattern_(std::move(pattern)) {
    const std::string text = with_single_blanks(pattern_);
    std::string expression;
    for (std::size_t at = 0; at < text.size();) {
      std::size_t end = text.find_first_of("{<|", at);
      if (end != at) {
        end = std::min(end, text.size());
        expression += std::regex_replace(text.substr(at, end - at), std::regex("[^A-Za-z0-9 ]"), "\\$&");
      } else {
        end = text[at] == '|' ? at + 2 : text.find(text[at] == '{' ? '}' : '>', at) + 1;
        expression += captured(text.substr(at, end - at));
      }
      pieces_.push_back(text.substr(at, end - at));
      at = end;
    }
    expression_ = std::regex(expression);
  }

  const std::string& pattern() const { return pattern_; }

  /// Whether a line is of this pattern; then it is compared with what stands there with the right numbers.
  bool explains(const std::string& printed, const Json& tree, const Derived& derived = {}) const {
    const std::string line = with_single_blanks(printed);
    std::smatch match;
    if (!std::regex_match(line, match, expression_)) return false;
    std::map<std::string, std::string> names;
    std::size_t group = 0;
    std::vector<std::string> found;  // of each piece
    for (const std::string& piece : pieces_) {
      found.push_back(is_literal(piece) ? piece : match[++group].str());
      if (piece.front() == '<') names[piece.substr(1, piece.find_first_of(".>") - 1)] = found.back();
    }
    std::string expected;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const std::string& piece = pieces_[i];
      expected +=
          piece.front() == '{' ? value(piece.substr(1, piece.size() - 2), names, tree, derived) : found[i];
    }
    EXPECT_EQ(line, expected) << "by " << pattern_;
    return true;
  }

 private:
  static bool is_literal(const std::string& piece) {
    return std::string("{<|").find(piece.front()) == std::string::npos;
  }
  static std::string captured(const std::string& piece) {
    if (piece.front() == '{') return "(.+?)";
    if (piece.front() == '|') return "((?:[#efms.][#efms. ]* )?)";
    if (piece.find("...>") != std::string::npos) return "([^0-9]*?)";
    return piece.find("..>") != std::string::npos ? "(\\S*?)" : "([A-Za-z_]\\w*)";
  }
  static std::string value(std::string path, const std::map<std::string, std::string>& names,
                           const Json& tree, const Derived& derived) {
    if (path.front() == '=') return derived.at(path.substr(1))(tree);
    for (const auto& [name, word] : names) {
      const std::size_t at = path.find("<" + name + ">");
      if (at != std::string::npos) path.replace(at, name.size() + 2, word);
    }
    const std::size_t hash = path.find('#');
    const Json* const entry = entry_at(tree, path.substr(0, hash));
    if (entry == nullptr) return "nothing: there is no " + path;
    if (hash == std::string::npos) return expected_with_unit(*entry);
    EXPECT_EQ(path.substr(hash + 1), expected_unit(*entry)) << path;
    return expected_text(*entry);
  }

  std::string pattern_;
  std::vector<std::string> pieces_;
  std::regex expression_;
};

}  // namespace parallax::test
