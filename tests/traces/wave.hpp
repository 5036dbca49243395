// SPDX-License-Identifier: Apache-2.0
// What a VCD says, by way of gtkwave's readers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/traces/tool.hpp"

namespace parallax::test {

// Changes of each signal of a VCD, by its name with its scopes.
struct Wave {
  std::string timescale;
  std::map<std::string, std::vector<std::pair<std::int64_t, std::int64_t>>> changes;

  explicit Wave(const std::string& text) {
    std::istringstream in(text);
    std::map<std::string, std::vector<std::string>>
        names;  // of a code: fst2vcd gives one to signals that are alike
    std::string word, scope;
    std::int64_t time = 0;
    const auto skip = [&] {
      std::string all;
      for (std::string part; in >> part && part != "$end";) all += part + " ";
      return all;
    };
    while (in >> word) {
      if (word == "$timescale")
        timescale = skip();
      else if (word == "$comment" || word == "$date" || word == "$version")
        skip();
      else if (word == "$scope") {
        in >> word >> word;
        scope += word + ".";
        skip();
      } else if (word == "$upscope") {
        scope.erase(scope.rfind('.', scope.size() - 2) + 1);
        skip();
      } else if (word == "$var") {
        std::string type, width, code, name;
        in >> type >> width >> code >> name;
        names[code].push_back(scope + name.substr(0, name.find('[')));
        skip();
      } else if (word[0] == '#') {
        time = std::stoll(word.substr(1));
      } else if (word[0] == 'b') {
        std::string code;
        in >> code;
        for (const std::string& name : names.at(code))
          changes[name].emplace_back(time, std::stoll(word.substr(1), nullptr, 2));
      } else if (word[0] == '0' || word[0] == '1') {
        for (const std::string& name : names.at(word.substr(1)))
          changes[name].emplace_back(time, word[0] - '0');
      }
    }
  }
  /// Whether a signal is `value` from `begin` (at the latest) until `end`.
  bool is(const std::string& signal, std::int64_t value, std::int64_t begin, std::int64_t end) const {
    const auto& list = changes.at(signal);
    auto next = std::upper_bound(list.begin(), list.end(),
                                 std::pair{begin, std::numeric_limits<std::int64_t>::max()});
    return next != list.begin() && std::prev(next)->second == value &&
           (next == list.end() || next->first >= end);
  }
  std::int64_t at(const std::string& signal, std::int64_t time) const {
    const auto& list = changes.at(signal);
    return std::prev(std::upper_bound(list.begin(), list.end(),
                                      std::pair{time, std::numeric_limits<std::int64_t>::max()}))
        ->second;
  }
};

/// A VCD as gtkwave understands it; needs vcd2fst and fst2vcd.
inline Wave read_wave(const std::string& vcd) {
  const std::string fst = vcd + ".fst";
  output_of("vcd2fst " + vcd + " " + fst);
  return Wave(output_of("fst2vcd " + fst));
}

}  // namespace parallax::test
