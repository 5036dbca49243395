// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/dump_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <string_view>

#include "platform/cosim/vcd_tokens.hpp"
#include "platform/input/text_file.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f'; }

std::size_t line_of(const std::string& text, const char* at) {
  return static_cast<std::size_t>(std::count(text.data(), at, '\n')) + 1;
}

bool has_prefix(std::string_view digits) {
  return digits.substr(0, 2) == "0x" || digits.substr(0, 2) == "0X";
}

// In $readmemh's text x is a digit.
constexpr const char* kNoPrefix = "hexadecimal words have no 0x before them here: that x is an unknown digit";

// Words, separated by blanks; comments as in Verilog; @address must be where the words are anyway, as
// $writememh has it.
TokenWords read_memh(const std::string& text, const std::string& path, std::size_t width) {
  TokenWords words(width);
  const char* at = text.data();
  const char* const end = at + text.size();
  std::uint64_t prefixed = 0;
  const auto fail = [&](const char* where, const std::string& what) {
    return UserError(fmt::format("{}, line {}: {}", path, line_of(text, where), what));
  };
  while (true) {
    while (at != end && is_blank(*at)) ++at;
    if (at == end) {
      if (prefixed > 1 && prefixed == words.size()) throw UserError(fmt::format("{}: {}", path, kNoPrefix));
      return words;
    }
    const char* const begin = at;
    if (*at == '/' && at + 1 != end && at[1] == '/') {
      at = std::find(at, end, '\n');
      continue;
    }
    if (*at == '/' && at + 1 != end && at[1] == '*') {
      static constexpr char kClose[] = "*/";
      at = std::search(at + 2, end, kClose, kClose + 2);
      if (at == end) throw fail(begin, "a comment /* has no end");
      at += 2;
      continue;
    }
    while (at != end && !is_blank(*at) && *at != '/') ++at;
    if (at == begin) throw fail(begin, "'/' begins neither a word nor a comment");
    if (*begin == '@') {
      std::uint64_t address = 0;
      const auto [stop, error] = std::from_chars(begin + 1, at, address, 16);
      if (error != std::errc() || stop != at || address != words.size()) {
        throw fail(begin,
                   fmt::format("'{}' is not the address of the next word, @{:x}: the words of a dump follow "
                               "each other from 0 on",
                               excerpt({begin, static_cast<std::size_t>(at - begin)}), words.size()));
      }
      continue;
    }
    const bool is_prefixed = has_prefix({begin, static_cast<std::size_t>(at - begin)});
    prefixed += is_prefixed;
    if (const std::string wrong = words.append_hex(begin, at); !wrong.empty())
      throw fail(begin, is_prefixed ? kNoPrefix : wrong);
  }
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    std::string_view cell = line.substr(0, comma);
    while (!cell.empty() && (is_blank(cell.front()) || cell.front() == '"')) cell.remove_prefix(1);
    while (!cell.empty() && (is_blank(cell.back()) || cell.back() == '"')) cell.remove_suffix(1);
    cells.push_back(cell);
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

// Columns of a CSV: which cell is what.
class CsvReader {
 public:
  CsvReader(const std::string& path, const VectorStream& stream) : path_(path), stream_(stream) {}

  Dump read(std::string_view text) {
    Dump dump{TokenWords(stream_.shape.format.width().size()), {}};
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      const std::string_view line = text.substr(0, end);
      text.remove_prefix(std::min(end + 1, text.size()));
      ++line_;
      const std::size_t first = line.find_first_not_of(" \t\r");
      if (first == std::string_view::npos || line[first] == '#') continue;
      const std::vector<std::string_view> cells = cells_of(line);
      if (columns_ == 0) {
        read_head(cells);
      } else {
        read_token(cells, dump);
      }
    }
    return dump;
  }

 private:
  UserError fault(const std::string& what) const {
    return UserError(fmt::format("{}, line {}: {}", path_, line_, what));
  }

  void read_head(const std::vector<std::string_view>& cells) {
    if (cells.size() == 1 && cells.front().find_first_of(";\t") != std::string_view::npos)
      throw fault("the columns of a CSV have commas between them");
    columns_ = cells.size();
    const std::vector<TokenField>& fields = stream_.shape.format.all();
    fields_.assign(fields.size(), kNone);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i] == "cycle") cycle_ = i;
      if (cells[i] == "valid") valid_ = i;
      if (cells[i] == "ready") ready_ = i;
      if (cells[i] == "data" || cells[i] == stream_.name || cells[i] == stream_.port) data_ = i;
      for (std::size_t f = 0; f < fields.size(); ++f) {
        if (cells[i] == fields[f].name) fields_[f] = i;
      }
    }
    if (data_ != kNone) return;
    for (std::size_t f = 0; f < fields.size(); ++f) {
      if (fields_[f] == kNone) {
        throw fault(
            fmt::format("no column {}: the first line names the columns, one for each field of {}, or "
                        "data for whole words",
                        fields[f].name, stream_.name));
      }
    }
  }

  void read_token(const std::vector<std::string_view>& cells, Dump& dump) const {
    if (cells.size() != columns_)
      throw fault(fmt::format("{} columns in place of {}", cells.size(), columns_));
    if (!is_set(valid_, cells) || !is_set(ready_, cells)) return;
    if (cycle_ != kNone) dump.cycles.push_back(number(cells[cycle_]));
    if (data_ != kNone) {
      std::string_view digits = cells[data_];
      if (has_prefix(digits)) digits.remove_prefix(2);
      if (digits.empty()) throw fault("no data");
      const std::string wrong = dump.words.append_hex(digits.data(), digits.data() + digits.size());
      if (!wrong.empty()) throw fault(wrong);
      return;
    }
    dump.words.append();
    const std::vector<TokenField>& fields = stream_.shape.format.all();
    for (std::size_t f = 0; f < fields.size(); ++f) {
      const std::string_view cell = cells[fields_[f]];
      if (cell.find_first_of("xXzZ") != std::string_view::npos && cell.substr(0, 2) != "0x") {
        dump.words.set_unknown(fields[f]);
        continue;
      }
      const std::int64_t value = number(cell);
      const std::size_t width = fields[f].width;
      const bool fits =
          width == 64 || (value < 0 ? value >= -(std::int64_t{1} << (width - 1)) : value >> width == 0);
      if (!fits) throw fault(fmt::format("{} = {} has no place in {} bits", fields[f].name, value, width));
      dump.words.set(fields[f], static_cast<std::uint64_t>(value));
    }
  }

  // Whether this column, if there is one, says that the row is a token.
  bool is_set(std::size_t column, const std::vector<std::string_view>& cells) const {
    if (column == kNone || cells[column] == "1") return true;
    if (cells[column] == "0") return false;
    throw fault(fmt::format("{} = {} is neither 0 nor 1", column == valid_ ? "valid" : "ready",
                            excerpt(cells[column])));
  }

  std::int64_t number(std::string_view cell) const {
    const bool is_negative = !cell.empty() && cell.front() == '-';
    std::string_view digits = cell.substr(is_negative ? 1 : 0);
    int base = 10;
    if (has_prefix(digits)) {
      digits.remove_prefix(2);
      base = 16;
    }
    std::uint64_t value = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
    if (digits.empty() || error != std::errc() || stop != digits.data() + digits.size())
      throw fault(fmt::format("'{}' is no whole number", excerpt(cell)));
    return static_cast<std::int64_t>(is_negative ? 0 - value : value);
  }

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  const std::string& path_;
  const VectorStream& stream_;
  std::size_t line_ = 0;
  std::size_t columns_ = 0;
  std::size_t cycle_ = kNone, data_ = kNone, valid_ = kNone, ready_ = kNone;
  std::vector<std::size_t> fields_;
};

// A VCD begins with a keyword; the first line of a CSV, behind lines of remarks (#), has a comma, or one
// name, or what others separate columns by.
bool is_vcd(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '$';
}

bool is_csv(std::string_view text, const VectorStream& stream) {
  while (!text.empty() && text.front() == '#')
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  const std::string_view line = text.substr(0, text.find('\n'));
  if (line.find("//") != std::string_view::npos) return false;
  const std::vector<std::string_view> cells = cells_of(line);
  if (cells.size() > 1) return true;
  // A name of a column, alone or with others behind what is no comma.
  const std::string_view name = cells.front().substr(0, cells.front().find_first_of(";\t"));
  const std::vector<TokenField>& fields = stream.shape.format.all();
  return name == "data" || name == "cycle" || name == stream.name || name == stream.port ||
         std::any_of(fields.begin(), fields.end(),
                     [&](const TokenField& field) { return name == field.name; });
}

}  // namespace

TokenWords read_vectors(const std::string& path, const VectorStream& stream) {
  const std::size_t width = stream.shape.format.width().size();
  TokenWords words = read_memh(read_text_file(path), path, width);
  VectorCheck check(width);
  std::vector<std::uint64_t> word;
  for (std::uint64_t token = 0; token < words.size(); ++token) {
    word.clear();
    for (std::size_t low = 0; low < width; low += 64)
      word.push_back(words.raw(token, {"", low, std::min<std::size_t>(64, width - low)}));
    check.add(word);
  }
  if (words.size() != stream.tokens || check.text() != stream.check) {
    throw UserError(fmt::format("{}: not the file that was written with its {}; run parallax vectors again",
                                path, VectorManifest::kFile));
  }
  return words;
}

Dump read_dump(const std::string& path, const VectorStream& stream, const DumpSignals& signals) {
  const std::string text = read_text_file(path);
  if (text.find('\0') != std::string::npos)
    throw UserError(fmt::format("{}: no text: a dump is a VCD, a CSV, or the text of $readmemh", path));
  if (is_vcd(text)) return tokens_of_vcd(text, path, stream, signals);
  if (is_csv(text, stream)) return CsvReader(path, stream).read(text);
  return {read_memh(text, path, stream.shape.format.width().size()), {}};
}

}  // namespace parallax
