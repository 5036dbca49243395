// SPDX-License-Identifier: Apache-2.0
#include "platform/input/address_trace.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <sstream>

#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr const char* kHeader = "time_ns,rw,addr,bytes";
constexpr std::uint64_t kMostBytes = 1 << 20;
constexpr double kLatest = 1e12;  // ns: a refresh is a step, and this many take seconds

std::string unpacked_file(const std::string& path) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), gzclose);
  if (!file) throw UserError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  std::string text;
  std::array<char, 1 << 16> buffer{};
  for (;;) {
    const int read = gzread(file.get(), buffer.data(), buffer.size());
    if (read < 0) {
      int code = 0;
      const char* const what = gzerror(file.get(), &code);
      throw UserError(
          fmt::format("{}: cannot be read: {}", path, code == Z_ERRNO ? std::strerror(errno) : what));
    }
    if (read == 0) {
      int code = Z_OK;
      gzerror(file.get(), &code);
      if (code == Z_BUF_ERROR)
        throw UserError(fmt::format("{}: ends in the middle of the compressed data", path));
      return text;
    }
    text.append(buffer.data(), read);
  }
}

// One line; what is wrong with it, if something is.
class Line {
 public:
  explicit Line(const std::string& text) : text_(text) {}

  std::string read(TraceRequest& request) {
    std::array<std::string, 4> fields;
    std::istringstream in(text_);
    for (std::string& field : fields) std::getline(in, field, ',');
    if (fields[3].empty() || in.rdbuf()->in_avail() > 0 || text_.back() == ',') {
      return fmt::format("expected four fields, {}", kHeader);
    }
    char* end = nullptr;
    request.time_ns = std::strtod(fields[0].c_str(), &end);
    if (fields[0].empty() || *end != '\0' || !(request.time_ns >= 0 && request.time_ns <= kLatest)) {
      return fmt::format("time_ns is '{}', expected a number from 0 to {:.0f}", fields[0], kLatest);
    }
    if (fields[1] != "R" && fields[1] != "W" && fields[1] != "r" && fields[1] != "w") {
      return fmt::format("rw is '{}', expected R or W", fields[1]);
    }
    request.write = fields[1] == "W" || fields[1] == "w";
    if (!number(fields[2], request.address)) {
      return fmt::format("addr is '{}', expected an address such as 0x1000, below 2^62", fields[2]);
    }
    if (!number(fields[3], request.bytes) || request.bytes == 0 || request.bytes > kMostBytes) {
      return fmt::format("bytes is '{}', expected a number from 1 to {}", fields[3], kMostBytes);
    }
    return "";
  }

 private:
  static bool number(const std::string& text, std::uint64_t& value) {
    if (text.empty() || text[0] < '0' || text[0] > '9') return false;
    const bool hexadecimal = text.rfind("0x", 0) == 0;
    char* end = nullptr;
    errno = 0;
    value = std::strtoull(text.c_str(), &end, hexadecimal ? 16 : 10);
    return *end == '\0' && errno == 0 && value < 1ull << 62;
  }

  const std::string& text_;
};

}  // namespace

std::vector<TraceRequest> read_address_trace(const std::string& path) {
  std::istringstream in(unpacked_file(path));
  std::vector<TraceRequest> trace;
  std::string line;
  double latest = 0;
  for (int number = 1; std::getline(in, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (number == 1) {
      if (line != kHeader) throw UserError(fmt::format("{}:1: expected the line '{}'", path, kHeader));
      continue;
    }
    if (line.empty()) continue;
    TraceRequest request;
    std::string fault = Line(line).read(request);
    if (fault.empty() && request.time_ns < latest) {
      fault = fmt::format("time_ns is {}, before {} of an earlier line", request.time_ns, latest);
    }
    if (!fault.empty()) throw UserError(fmt::format("{}:{}: {}", path, number, fault));
    latest = request.time_ns;
    trace.push_back(request);
  }
  if (trace.empty()) throw UserError(fmt::format("{}: holds no request", path));
  return trace;
}

}  // namespace parallax
