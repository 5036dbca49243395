// SPDX-License-Identifier: Apache-2.0
// A page of documentation as data: its fenced blocks, headings and links.
#pragma once

#include <cctype>
#include <cmath>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace parallax::test {

inline std::string read_text(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

struct FencedBlock {
  std::string language;
  std::string note;  ///< of an HTML comment on the line before, as in `<!-- not run: installs packages -->`
  std::size_t line = 0;  ///< of the opening fence, from 1
  std::vector<std::string> lines;
};

inline std::vector<FencedBlock> fenced_blocks(const std::string& markdown) {
  static const std::regex comment("<!-- (.*) -->");
  std::vector<FencedBlock> blocks;
  bool inside = false;
  std::string note;
  std::size_t number = 0;
  for (const std::string& line : lines_of(markdown)) {
    ++number;
    if (line.rfind("```", 0) == 0) {
      if (!inside) blocks.push_back({line.substr(3), note, number, {}});
      inside = !inside;
      note.clear();
    } else if (inside) {
      blocks.back().lines.push_back(line);
    } else if (std::smatch found; std::regex_match(line, found, comment)) {
      note = found[1];
    } else {
      note.clear();
    }
  }
  return blocks;
}

/// One command of a `console` block with what is shown below it. "$ echo $?" after it states its exit code.
struct Command {
  std::string text;
  std::size_t line = 0;
  int exit_code = 0;
  std::vector<std::string> shown;
};

inline std::vector<Command> commands_of(const FencedBlock& block) {
  std::vector<Command> commands;
  bool states_code = false;
  bool goes_on = false;
  for (std::size_t i = 0; i < block.lines.size(); ++i) {
    const std::string& line = block.lines[i];
    if (goes_on) {
      commands.back().text += "\n" + line;
    } else if (line == "$ echo $?") {
      states_code = true;
    } else if (line.rfind("$ ", 0) == 0) {
      commands.push_back({line.substr(2), block.line + i + 1, 0, {}});
    } else if (commands.empty()) {
      throw std::runtime_error("a console block begins with a command, not with: " + line);
    } else if (states_code) {
      commands.back().exit_code = std::stoi(line);
      states_code = false;
    } else {
      commands.back().shown.push_back(line);
      continue;
    }
    goes_on = !line.empty() && line.back() == '\\';
  }
  return commands;
}

/// Text apart from its numbers, so that a small change of a number is no failure.
struct Shape {
  std::string text;  ///< "#" for each number, one space for several
  std::vector<double> numbers;
};

inline Shape shape_of(const std::string& line) {
  static const std::regex number("[0-9]+(\\.[0-9]+)?");
  static const std::regex space(" +");
  Shape shape;
  for (std::sregex_iterator i(line.begin(), line.end(), number), end; i != end; ++i) {
    shape.numbers.push_back(std::stod(i->str()));
  }
  shape.text = std::regex_replace(std::regex_replace(line, number, "#"), space, " ");
  return shape;
}

/// Whether a line of a page shows what was printed: the same text, numbers within 10 %. A line that ends
/// in " ..." shows the beginning only.
inline bool shows(const std::string& line, const std::string& printed) {
  const std::string more = " ...";
  const bool begins = line.size() > more.size() && line.substr(line.size() - more.size()) == more;
  const Shape want = shape_of(begins ? line.substr(0, line.size() - more.size()) : line);
  const Shape have = shape_of(printed);
  if (begins ? have.text.rfind(want.text, 0) != 0 : have.text != want.text) return false;
  for (std::size_t i = 0; i < want.numbers.size(); ++i) {
    const double difference = std::abs(want.numbers[i] - have.numbers[i]);
    if (difference > 0.1 * want.numbers[i] && difference > 0.051) return false;
  }
  return true;
}

/// The lines outside of fenced blocks.
inline std::vector<std::string> prose_of(const std::string& markdown) {
  std::vector<std::string> prose;
  bool inside = false;
  for (const std::string& line : lines_of(markdown)) {
    const bool fence = line.rfind("```", 0) == 0;
    if (!fence && !inside) prose.push_back(line);
    if (fence) inside = !inside;
  }
  return prose;
}

/// What "page.md#..." leads to: each heading in small letters, without punctuation, with hyphens for blanks.
inline std::set<std::string> anchors_of(const std::string& markdown) {
  std::set<std::string> anchors;
  for (const std::string& line : prose_of(markdown)) {
    const std::size_t begin = line.find_first_not_of('#');
    if (begin == 0 || begin == std::string::npos || line[begin] != ' ') continue;
    std::string anchor;
    for (const char c : line.substr(begin + 1)) {
      const auto letter = static_cast<unsigned char>(c);
      if (std::isalnum(letter) != 0 || c == '-' || c == '_')
        anchor += static_cast<char>(std::tolower(letter));
      if (c == ' ') anchor += '-';
    }
    anchors.insert(anchor);
  }
  return anchors;
}

/// Where its links lead: "page.md", "page.md#heading", "#heading", "https://...".
inline std::vector<std::string> links_of(const std::string& markdown) {
  static const std::regex link("\\]\\(([^)]+)\\)");
  std::vector<std::string> links;
  for (const std::string& line : prose_of(markdown)) {
    for (std::sregex_iterator i(line.begin(), line.end(), link), end; i != end; ++i) links.push_back((*i)[1]);
  }
  return links;
}

}  // namespace parallax::test
