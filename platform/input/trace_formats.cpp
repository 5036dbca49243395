// SPDX-License-Identifier: Apache-2.0
#include "platform/input/trace_formats.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <optional>
#include <set>
#include <sstream>

#include "platform/input/letters.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr std::uint64_t kLongestRequest = 1 << 20;
constexpr double kLatestRequest = 1e12;  // ns: a refresh is a step, and this many take seconds

using Fields = std::vector<std::string>;

std::string trimmed_field(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

Fields trace_words(const std::string& line) {
  std::istringstream in(line);
  Fields found;
  for (std::string word; in >> word;) found.push_back(word);
  return found;
}

Fields between_commas(const std::string& line) {
  Fields found;
  std::istringstream in(line + ",");
  for (std::string field; std::getline(in, field, ',');) found.push_back(trimmed_field(field));
  return found;
}

bool has_base_16(const std::string& text) { return text.rfind("0x", 0) == 0 || text.rfind("0X", 0) == 0; }

std::optional<std::uint64_t> whole_number(const std::string& text, int base) {
  const std::string digits = base == 16 && has_base_16(text) ? text.substr(2) : text;
  const char* const allowed = base == 16 ? "0123456789abcdefABCDEF" : "0123456789";
  if (digits.empty() || digits.find_first_not_of(allowed) != std::string::npos) return std::nullopt;
  errno = 0;
  const std::uint64_t value = std::strtoull(digits.c_str(), nullptr, base);
  if (errno != 0 || value >= 1ull << 62) return std::nullopt;
  return value;
}

// Whether a word says that something is read or written, as any of the programs does.
std::optional<bool> is_write(const std::string& word) {
  static const std::set<std::string> reads{"r",        "rd",      "read",   "ld",       "load",
                                           "p_mem_rd", "p_fetch", "ifetch", "p_lock_rd"};
  static const std::set<std::string> writes{"w",     "wr",       "write",     "st",
                                            "store", "p_mem_wr", "p_lock_wr", "boff"};
  if (writes.count(lower(word)) > 0) return true;
  if (reads.count(lower(word)) > 0) return false;
  return std::nullopt;
}

std::string read_operation(const std::string& word, TraceRequest& request) {
  const auto write = is_write(word);
  if (!write) return fmt::format("the operation is '{}', expected one such as R or W", excerpt(word));
  request.write = *write;
  return "";
}

std::string read_address(const std::string& word, int base, TraceRequest& request) {
  const auto number = whole_number(word, base);
  if (!number)
    return fmt::format("the address is '{}', expected one such as 0x1000, below 2^62", excerpt(word));
  request.address = *number;
  return "";
}

std::string read_cycle(const std::string& word, TraceRequest& request) {
  const auto number = whole_number(word, 10);
  if (!number) return fmt::format("the cycle is '{}', expected a whole number", excerpt(word));
  request.time_ns = static_cast<double>(*number);
  return "";
}

std::string read_length(const std::string& word, TraceRequest& request) {
  const auto number = whole_number(word, 10);
  if (!number || *number == 0 || *number > kLongestRequest)
    return fmt::format("the length is '{}', expected a number from 1 to {}", excerpt(word), kLongestRequest);
  request.bytes = *number;
  return "";
}

// The first fault of several, if there is one.
std::string first_of(std::initializer_list<std::string> faults) {
  const auto* const found =
      std::find_if(faults.begin(), faults.end(), [](const std::string& fault) { return !fault.empty(); });
  return found == faults.end() ? "" : *found;
}

std::string read_csv(const std::string& line, TraceRequest& request) {
  const Fields fields = between_commas(line);
  if (fields.size() != 4 || fields[3].empty()) return fmt::format("expected four fields, {}", kTraceHeader);
  char* end = nullptr;
  request.time_ns = std::strtod(fields[0].c_str(), &end);
  if (fields[0].empty() || *end != '\0' || !(request.time_ns >= 0 && request.time_ns <= kLatestRequest))
    return fmt::format("time_ns is '{}', expected a number from 0 to {:.0f}", excerpt(fields[0]),
                       kLatestRequest);
  const std::string rw = lower(fields[1]);
  if (rw != "r" && rw != "w") return fmt::format("rw is '{}', expected R or W", excerpt(fields[1]));
  request.write = rw == "w";
  const auto at = whole_number(fields[2], has_base_16(fields[2]) ? 16 : 10);
  if (!at)
    return fmt::format("addr is '{}', expected an address such as 0x1000, below 2^62", excerpt(fields[2]));
  request.address = *at;
  const auto bytes = whole_number(fields[3], has_base_16(fields[3]) ? 16 : 10);
  if (!bytes || *bytes == 0 || *bytes > kLongestRequest)
    return fmt::format("bytes is '{}', expected a number from 1 to {}", excerpt(fields[3]), kLongestRequest);
  request.bytes = *bytes;
  return "";
}

// 0x1234 R
bool is_ramulator(const std::string& line) {
  const Fields fields = trace_words(line);
  return fields.size() == 2 && whole_number(fields[0], 16) && is_write(fields[1]);
}

std::string read_ramulator(const std::string& line, TraceRequest& request) {
  const Fields fields = trace_words(line);
  if (fields.size() != 2) return "expected two words, such as 0x1234 R";
  return first_of({read_address(fields[0], 16, request), read_operation(fields[1], request)});
}

// LD 0x1234, where an address without 0x is decimal.
bool is_load_store(const std::string& line) {
  const Fields fields = trace_words(line);
  return fields.size() == 2 && is_write(fields[0]) &&
         whole_number(fields[1], has_base_16(fields[1]) ? 16 : 10);
}

std::string read_load_store(const std::string& line, TraceRequest& request) {
  const Fields fields = trace_words(line);
  if (fields.size() != 2) return "expected two words, such as LD 0x1234";
  return first_of({read_operation(fields[0], request),
                   read_address(fields[1], has_base_16(fields[1]) ? 16 : 10, request)});
}

// 0x1234 READ 10
bool is_dramsim(const std::string& line) {
  const Fields fields = trace_words(line);
  return fields.size() == 3 && whole_number(fields[0], 16) && is_write(fields[1]) &&
         whole_number(fields[2], 10);
}

std::string read_dramsim(const std::string& line, TraceRequest& request) {
  const Fields fields = trace_words(line);
  if (fields.size() != 3) return "expected three words, such as 0x1234 READ 10";
  return first_of({read_address(fields[0], 16, request), read_operation(fields[1], request),
                   read_cycle(fields[2], request)});
}

// 10: read 0x1234, or 10: (64) read 0x1234; what a write writes may follow.
Fields stl_words(const std::string& line) {
  std::string spaced;
  for (const char c : line) {
    if (c == '(') spaced += ' ';
    spaced += c;
    if (c == ':' || c == ')') spaced += ' ';
  }
  Fields fields = trace_words(spaced);
  if (fields.size() > 1 && fields[1] == ":") {
    fields[0] += ':';
    fields.erase(fields.begin() + 1);
  }
  return fields;
}

bool is_stl(const std::string& line) {
  const Fields fields = stl_words(line);
  return fields.size() > 2 && fields[0].back() == ':' &&
         whole_number(fields[0].substr(0, fields[0].size() - 1), 10);
}

std::string read_stl(const std::string& line, TraceRequest& request) {
  Fields fields = stl_words(line);
  std::string bytes;
  const auto parenthesis = std::find_if(fields.begin(), fields.end(),
                                        [](const std::string& field) { return field.front() == '('; });
  if (parenthesis != fields.end()) {
    bytes = parenthesis->back() == ')' ? parenthesis->substr(1, parenthesis->size() - 2) : *parenthesis;
    fields.erase(parenthesis);
  }
  if (fields.size() < 3 || fields.size() > 4 || fields[0].back() != ':')
    return "expected a cycle, an operation and an address, such as 10: read 0x1234";
  return first_of({read_cycle(fields[0].substr(0, fields[0].size() - 1), request),
                   parenthesis == fields.end() && bytes.empty() ? "" : read_length(bytes, request),
                   read_operation(fields[1], request), read_address(fields[2], 16, request)});
}

const std::vector<TraceFormat>& trace_formats() {
  static const std::vector<TraceFormat> formats{
      {"CSV", kTraceHeader, false, true, true, is_trace_header, read_csv},
      {"DRAMSys", "10: read 0x1234", true, false, true, is_stl, read_stl},
      {"DRAMsim3", "0x1234 READ 10", true, false, false, is_dramsim, read_dramsim},
      {"Ramulator", "0x1234 R", false, false, false, is_ramulator, read_ramulator},
      {"Ramulator 2", "LD 0x1234", false, false, false, is_load_store, read_load_store}};
  return formats;
}

// Known traces that do not say what goes to the memory, and when.
std::string other_format(const std::string& line) {
  const Fields fields = trace_words(line);
  if (fields.size() == 2 && is_write(fields[0]) && fields[1].find(',') != std::string::npos)
    return "this looks like a trace of address vectors, which only their simulator's mapping makes "
           "addresses; ";
  const bool numbers = std::all_of(fields.begin(), fields.end(), [](const std::string& field) {
    return whole_number(field, 10).has_value();
  });
  if (numbers && (fields.size() == 2 || fields.size() == 3))
    return "this looks like a trace of a processor (instructions, addresses), which needs a model of one; ";
  return "";
}

}  // namespace

bool is_trace_header(const std::string& line) {
  std::string packed = lower(line);
  packed.erase(std::remove_if(packed.begin(), packed.end(), [](char c) { return c == ' ' || c == '\t'; }),
               packed.end());
  return packed == kTraceHeader;
}

const TraceFormat& trace_format_of(const std::string& line) {
  for (const TraceFormat& format : trace_formats()) {
    if (format.is(line)) return format;
  }
  std::vector<std::string> forms;
  for (const TraceFormat& format : trace_formats())
    forms.push_back(fmt::format("'{}' ({})", format.form, format.name));
  throw UserError(fmt::format("'{}' begins no trace that is known; {}expected a line such as {}",
                              excerpt(line), other_format(line), fmt::join(forms, ", ")));
}

}  // namespace parallax
