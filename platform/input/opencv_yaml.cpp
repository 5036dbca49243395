// SPDX-License-Identifier: Apache-2.0
#include "platform/input/opencv_yaml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

namespace parallax {
namespace {

bool is_printed(char c) { return static_cast<unsigned char>(c) >= ' '; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

class Walk {
 public:
  explicit Walk(std::string_view text) : text_(text) {}

  OpenCvYaml walk() {
    if (begin_document() && walk_value() && open_.empty()) check_end();
    return {deepest_, fault_};
  }

 private:
  enum class Kind { kMap, kSequence, kFlowMap, kFlowSequence };
  struct Open {
    Kind kind;
    std::size_t column;  // of the first entry of a block
  };

  char at(std::size_t i) const { return i < text_.size() ? text_[i] : '\0'; }
  char here() const { return at(at_); }
  bool ended() const { return at_ >= text_.size(); }
  std::size_t column() const { return at_ - line_begin_; }
  bool in_flow() const {
    return !open_.empty() &&
           (open_.back().kind == Kind::kFlowMap || open_.back().kind == Kind::kFlowSequence);
  }
  bool marks(const char* mark) const { return text_.compare(at_, 3, mark) == 0; }

  void push(Kind kind) {
    open_.push_back({kind, column()});
    deepest_ = std::max(deepest_, open_.size());
  }

  void next_line() {
    at_ = std::min(text_.find('\n', at_), text_.size());
    if (!ended()) ++at_;
    line_begin_ = at_;
    ++line_;
  }

  // To the next character that counts, over comments and ends of lines. Says no at the end of the text, and
  // where there is something else that is not printed.
  bool skip_blanks() {
    while (!ended()) {
      while (here() == ' ') ++at_;
      const char c = here();
      if (ended()) break;
      if (c == '#' || c == '\n' || c == '\r') {
        next_line();
      } else {
        return is_printed(c);
      }
    }
    return false;
  }

  bool blank_behind(std::size_t from) const {
    const char c = at(std::min(text_.find_first_not_of(' ', from), text_.size()));
    return c == '\0' || c == '\n' || c == '\r' || c == '#';
  }

  bool fail(const char* what) {
    fault_ = fmt::format("line {}: {}", line_, what);
    return false;
  }

  // To the first entry.
  bool begin_document() {
    while (skip_blanks() && here() == '%') next_line();
    if (ended()) return false;
    if (marks("---")) {
      if (!blank_behind(at_ + 3)) return fail("text behind ---; entries begin on a line of their own");
      next_line();
    }
    if (!skip_blanks()) return false;
    if (marks("...")) check_end();
    return fault_.empty() && !marks("...");
  }

  // Nothing may follow but the mark of the end.
  void check_end() {
    if (!skip_blanks()) return;
    if (marks("...")) {
      if (!blank_behind(at_ + 3)) {
        fail("text behind ...");
        return;
      }
      next_line();
      if (!skip_blanks()) return;
    }
    fail("text behind the end of the document, which OpenCV does not read");
  }

  // Up to a character that ends a plain word, or the end of the line.
  void skip_word(const char* ends) {
    while (is_printed(here()) && std::string_view(ends).find(here()) == std::string_view::npos) ++at_;
  }

  // A key and its colon.
  bool skip_key() {
    if (here() == '-') return false;
    skip_word(":");
    return at_++ < text_.size() && text_[at_ - 1] == ':';
  }

  bool skip_quoted() {
    const char quote = here();
    for (++at_; is_printed(here()); ++at_) {
      if (here() == '\\' && quote == '"') {
        ++at_;
      } else if (here() == quote) {
        ++at_;
        if (quote == '"' || here() != quote) return true;
      }
    }
    return false;
  }

  // A type, up to the value.
  bool skip_tag() {
    const std::size_t begin = at_;
    skip_word(" ");
    std::string_view name = text_.substr(begin, at_ - begin);
    if (!name.empty() && name.back() == '>') name.remove_suffix(1);
    constexpr std::string_view kBinary = "binary";
    forced_ = name;
    is_binary_ = name.size() >= kBinary.size() && name.substr(name.size() - kBinary.size()) == kBinary;
    return is_binary_ ? skip_base64() : skip_blanks();
  }

  // The rows behind a | begin in one column. The parser does not come back from some others.
  bool skip_base64() {
    while (here() == ' ') ++at_;
    if (here() != '|' || !is_end_of_line(text_.find_first_not_of(' ', at_ + 1)))
      return fail("!!binary without | and rows of base64");
    next_line();
    bool more = skip_blanks();
    for (const std::size_t first = column(); more && column() == first; more = skip_blanks()) {
      while (std::isalnum(static_cast<unsigned char>(here())) != 0 || here() == '+' || here() == '/' ||
             here() == '=')
        ++at_;
      if (!is_end_of_line(text_.find_first_not_of(' ', at_))) return fail("not a row of base64");
    }
    return true;
  }

  bool is_end_of_line(std::size_t i) const {
    return i >= text_.size() || text_[i] == '\n' || text_[i] == '\r';
  }

  // A value and all that lies in it, and what follows in the blocks that it lies in. Says no where the parser
  // would not go on.
  bool walk_value() {
    for (;;) {
      // Behind a type the parser takes a sign for what it is not, as it has not looked at what follows.
      const bool typed = here() == '!';
      forced_ = {};
      if (typed) {
        if (!skip_tag()) return false;
        if (is_binary_) {
          if (!go_on()) return open_.empty();
          continue;
        }
      }
      if (typed && forced_.substr(0, 2) == "!!" && (here() == '-' || here() == '+') &&
          (is_digit(at(at_ + 1)) || at(at_ + 1) == '.'))
        return fail("a type before a number with a sign, which OpenCV takes for something else");
      const char c = here(), d = typed ? ' ' : at(at_ + 1);
      const bool sign = c == '-' || c == '+';
      const bool number = is_digit(c) || (sign && (is_digit(d) || d == '.')) ||
                          (c == '.' && std::isalnum(static_cast<unsigned char>(d)) != 0);
      if (forced_ == "!str" && c != '"' && c != '\'') {
        skip_word(in_flow() ? ",}]" : "");
      } else if (number || forced_ == "!int" || forced_ == "!float") {
        skip_word(" ,]}#");
      } else if (c == '"' || c == '\'') {
        if (!skip_quoted()) return false;
      } else if (c == '[' || c == '{') {
        push(c == '[' ? Kind::kFlowSequence : Kind::kFlowMap);
        ++at_;
        first_ = true;
      } else if (in_flow()) {
        const std::size_t begin = at_;
        skip_word(",}]");
        if (at_ == begin) return false;
      } else if (c == '-') {
        push(Kind::kSequence);
        ++at_;
        if (!skip_blanks()) return false;
        continue;
      } else {
        const std::size_t begin = at_;
        skip_word(":");
        if (here() == ':') {
          const std::size_t behind = at_ + 1;
          at_ = begin;
          push(Kind::kMap);
          at_ = behind;
          if (!skip_blanks()) return false;
          continue;
        }
      }
      if (!go_on()) return open_.empty();
    }
  }

  // From behind a value to the next one. Says no at the end of the document, when nothing is open, and where
  // the text is malformed.
  bool go_on() {
    while (in_flow()) {
      const bool map = open_.back().kind == Kind::kFlowMap;
      if (!skip_blanks()) return false;
      if (here() == '}' || here() == ']') {
        if ((here() == '}') != map) return false;
        ++at_;
        open_.pop_back();
        first_ = false;
        continue;
      }
      if (!std::exchange(first_, false)) {
        if (here() != ',') return false;
        ++at_;
        if (!skip_blanks()) return false;
      }
      if (!map && here() == ']') {  // which closes what is around, too
        open_.pop_back();
        continue;
      }
      if (map && !skip_key()) return false;
      return skip_blanks();
    }
    return next_of_block();
  }

  bool next_of_block() {
    const bool more = skip_blanks();
    if (!more && !ended()) return false;
    const std::size_t where = more ? column() : 0;
    while (!open_.empty()) {
      if (more && where > open_.back().column) return false;
      if (more && where == open_.back().column && !marks("...")) break;
      open_.pop_back();
    }
    if (open_.empty()) return false;
    if (open_.back().kind == Kind::kSequence) {
      if (here() != '-') return false;
      ++at_;
    } else if (!skip_key()) {
      return false;
    }
    return skip_blanks();
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_begin_ = 0;
  int line_ = 1;
  std::vector<Open> open_;
  std::size_t deepest_ = 0;
  bool first_ = false;       // of a flow: nothing is in it yet
  std::string_view forced_;  // the type before a value
  bool is_binary_ = false;   // whether it is base64
  std::string fault_;
};

}  // namespace

OpenCvYaml look_at_opencv_yaml(std::string_view text) { return Walk(text).walk(); }

}  // namespace parallax
