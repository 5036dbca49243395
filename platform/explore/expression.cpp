// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/expression.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <string_view>

#include "platform/config/nearest_key.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr std::array<std::string_view, 15> kKeywords{"and",  "or",   "not",  "between", "in",
                                                     "is",   "null", "case", "when",    "then",
                                                     "else", "end",  "like", "true",    "false"};

// What has the same value on every computer, every time.
constexpr std::array<std::string_view, 25> kFunctions{
    "abs",    "ceil", "ceiling", "coalesce", "exp",  "floor", "ifnull", "iif", "instr",
    "length", "ln",   "log",     "log10",    "log2", "lower", "max",    "min", "mod",
    "nullif", "pow",  "power",   "round",    "sign", "sqrt",  "substr"};

bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }

bool goes_on(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.'; }

template <class Words>
bool is_one_of(const Words& words, std::string word) {
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(words.begin(), words.end(), word) != words.end();
}

// The same with "?3" in the place of the third name.
class Translation {
 public:
  Translation(const std::string& text, const std::vector<std::string>& names, const std::string& origin)
      : text_(text), names_(names), origin_(origin) {}

  /// Number of the last name in it.
  int last() const { return last_; }

  std::string run() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\'') {
        copy_text();
      } else if (begins_name(c)) {
        copy_word();
      } else if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
        copy_number();
      } else {
        refuse_other(c);
        open_ += c == '(' ? 1 : c == ')' ? -1 : 0;
        if (open_ < 0) fail("a parenthesis is closed that is not open");
        result_ += text_[at_++];
      }
    }
    return result_;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw UserError(fmt::format("{}: '{}': {}", origin_, excerpt(text_), why));
  }

  void copy_text() {
    const std::size_t end = text_.find('\'', at_ + 1);
    if (end == std::string::npos) fail("a quote is not closed");
    result_ += text_.substr(at_, end + 1 - at_);
    at_ = end + 1;
  }

  void copy_word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && goes_on(text_[at_])) ++at_;
    const std::string word = text_.substr(begin, at_ - begin);
    const std::size_t next = std::min(text_.find_first_not_of(" \t", at_), text_.size());
    const bool function = next < text_.size() && text_[next] == '(';
    if (is_one_of(kKeywords, word)) {
      result_ += word;
      return;
    }
    if (function) {
      if (!is_one_of(kFunctions, word)) fail(fmt::format("{}() is no function here", word));
      result_ += word;
      return;
    }
    const auto found = std::find(names_.begin(), names_.end(), word);
    if (found == names_.end()) {
      fail(fmt::format("{} is neither varied nor linked before; the nearest is {}", word,
                       nearest_key(word, names_)));
    }
    const auto number = static_cast<int>(found - names_.begin()) + 1;
    last_ = std::max(last_, number);
    result_ += fmt::format("?{}", number);
  }

  // 1.5e6: its letter begins no name.
  void copy_number() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      const bool sign = (c == '+' || c == '-') && (text_[at_ - 1] == 'e' || text_[at_ - 1] == 'E');
      if (!goes_on(c) && !sign) return;
      result_ += c;
      ++at_;
    }
  }

  void refuse_other(char c) const {
    constexpr std::string_view kAllowed = " \t+-*/%=<>!(),&|~";
    if (kAllowed.find(c) == std::string_view::npos) fail(fmt::format("'{}' has no place here", c));
    if (text_.compare(at_, 2, "--") == 0 || text_.compare(at_, 2, "/*") == 0) fail("it has no comments");
  }

  const std::string& text_;
  const std::vector<std::string>& names_;
  const std::string& origin_;
  std::size_t at_ = 0;
  int last_ = 0;
  int open_ = 0;  // parentheses
  std::string result_;
};

void bind(SQLite::Statement& statement, int place, const ConfigValue& value) {
  if (const auto* truth = std::get_if<bool>(&value)) {
    statement.bind(place, *truth ? 1 : 0);
  } else if (const auto* whole = std::get_if<std::int64_t>(&value)) {
    statement.bind(place, *whole);
  } else if (const auto* real = std::get_if<double>(&value)) {
    statement.bind(place, *real);
  } else {
    statement.bind(place, std::get<std::string>(value));
  }
}

}  // namespace

struct Expression::Compiled {
  std::string text;
  std::string origin;
  SQLite::Database nothing{":memory:", SQLite::OPEN_READWRITE};
  std::unique_ptr<SQLite::Statement> statement;
  int places = 0;

  // The statement, at its only row.
  SQLite::Statement& row(const std::vector<ConfigValue>& values) {
    statement->reset();
    for (int i = 0; i < places; ++i) bind(*statement, i + 1, values[static_cast<std::size_t>(i)]);
    statement->executeStep();
    return *statement;
  }
};

Expression::Expression(const std::string& text, const std::vector<std::string>& names,
                       const std::string& origin)
    : compiled_(std::make_unique<Compiled>()) {
  compiled_->text = text;
  compiled_->origin = origin;
  Translation translation(text, names, origin);
  const std::string translated = translation.run();
  compiled_->places = translation.last();
  try {
    compiled_->statement =
        std::make_unique<SQLite::Statement>(compiled_->nothing, "SELECT (" + translated + ")");
  } catch (const SQLite::Exception& error) {
    throw UserError(fmt::format("{}: '{}': {}", origin, excerpt(text), error.what()));
  }
}

Expression::~Expression() = default;
Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(Expression&&) noexcept = default;

ConfigValue Expression::value(const std::vector<ConfigValue>& values) {
  const SQLite::Column column = compiled_->row(values).getColumn(0);
  if (column.isInteger()) return column.getInt64();
  if (column.isFloat()) return column.getDouble();
  if (column.isText()) return column.getString();
  throw UserError(fmt::format("{}: '{}' has no value", compiled_->origin, excerpt(compiled_->text)));
}

bool Expression::holds(const std::vector<ConfigValue>& values) {
  const SQLite::Column column = compiled_->row(values).getColumn(0);
  return !column.isNull() && column.getDouble() != 0;
}

}  // namespace parallax
