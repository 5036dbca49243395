// SPDX-License-Identifier: Apache-2.0
#include "platform/input/address_trace.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

#include "platform/files/open_stream.hpp"
#include "platform/input/input_file.hpp"
#include "platform/input/trace_formats.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr std::uint64_t kUsualBytes = 64;           // a line of a cache
constexpr double kLatestTime = 1e12;                // ns: a refresh is a step, and this many take seconds
constexpr std::size_t kMostRequests = 100'000'000;  // 3 GB of memory

// The lines of a file, plain or compressed.
class Lines {
 public:
  explicit Lines(const std::string& path) : path_(path), file_(nullptr, gzclose) {
    const int descriptor = open_stream(path);
    if (descriptor >= 0) file_.reset(gzdopen(descriptor, "rb"));
    if (!file_) throw UserError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  }

  /// Says no behind the last one.
  bool next(std::string& line) {
    line.clear();
    for (;;) {
      const char* const begin = buffer_.data() + at_;
      const auto* const newline = static_cast<const char*>(std::memchr(begin, '\n', end_ - at_));
      line.append(begin, newline == nullptr ? end_ - at_ : static_cast<std::size_t>(newline - begin));
      ++number_;
      if (line.size() > kLongestLine)
        throw UserError(fmt::format("{}:{}: has more than {} characters", path_, number_, kLongestLine));
      if (newline != nullptr) {
        at_ += static_cast<std::size_t>(newline - begin) + 1;
        return true;
      }
      if (!fill()) return !line.empty();
      --number_;
    }
  }
  int number() const { return number_; }

 private:
  static constexpr std::size_t kLongestLine = 1000;
  static constexpr unsigned kChunk = 1U << 16;

  bool fill() {
    const int read = gzread(file_.get(), buffer_.data(), unsigned{kChunk});
    int code = Z_OK;
    const char* const what = gzerror(file_.get(), &code);
    if (read < 0)
      throw UserError(
          fmt::format("{}: cannot be read: {}", path_, code == Z_ERRNO ? std::strerror(errno) : what));
    if (read == 0 && code == Z_BUF_ERROR)
      throw UserError(fmt::format("{}: ends in the middle of the compressed data", path_));
    at_ = 0;
    end_ = static_cast<std::size_t>(read);
    return read > 0;
  }

  const std::string path_;
  std::unique_ptr<gzFile_s, int (*)(gzFile)> file_;
  std::array<char, kChunk> buffer_{};
  std::size_t at_ = 0, end_ = 0;
  int number_ = 0;
};

// A line without comment, carriage return and blanks at its ends.
std::string content_of(std::string line) {
  const std::size_t comment = line.find('#');
  if (comment != std::string::npos) line.erase(comment);
  constexpr const char* kBlanks = " \t\r";
  const std::size_t begin = line.find_first_not_of(kBlanks);
  return begin == std::string::npos ? "" : line.substr(begin, line.find_last_not_of(kBlanks) - begin + 1);
}

// How the requests of a format are taken.
struct Taken {
  double cycle_ns = 1;
  std::uint64_t bytes = kUsualBytes;
};

Taken taken(const std::string& path, const TraceFormat& format, const TraceReading& reading,
            const std::function<void(const std::string&)>& notice) {
  if (reading.mhz && !format.has_cycles)
    throw UserError(
        fmt::format("--trace-mhz: {} counts no cycles, it is a trace like {}", path, format.form));
  if (reading.bytes && format.has_bytes)
    throw UserError(fmt::format("--request-bytes: each request of {} says how long it is", path));
  Taken result;
  result.bytes = reading.bytes.value_or(kUsualBytes);
  if (format.has_cycles) result.cycle_ns = reading.mhz ? 1000 / *reading.mhz : reading.cycle_ns;
  if (!format.has_bytes && notice) {
    notice(fmt::format(
        "{}: taken as a trace of {} ({}): {} bytes a request{}, {}", path, format.name, format.form,
        result.bytes, format.may_have_bytes ? " that does not say" : "",
        format.has_cycles
            ? fmt::format("cycles of {:g} ns; --request-bytes and --trace-mhz state others", result.cycle_ns)
            : std::string("all at once; --request-bytes states another")));
  }
  return result;
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

std::vector<TraceRequest> read_address_trace(const std::string& path, const TraceReading& reading,
                                             const std::function<void(const std::string&)>& notice) {
  if (ends_with(path, ".rstl") || ends_with(path, ".rstl.gz")) {
    throw UserError(fmt::format(
        "{}: times that count from the end of the request before are not replayed; expected a .stl trace",
        path));
  }
  Lines lines(path);
  std::vector<TraceRequest> trace;
  const TraceFormat* format = nullptr;
  Taken as;
  std::string raw;
  double latest = 0;
  while (lines.next(raw)) {
    const int number = lines.number();
    const auto fail = [&](const std::string& fault) {
      return UserError(fmt::format("{}:{}: {}", path, number, fault));
    };
    if (number == 1 && raw.rfind(kByteOrderMark, 0) == 0) raw.erase(0, kByteOrderMark.size());
    const std::string line = content_of(raw);
    if (line.empty()) continue;
    if (format == nullptr) {
      try {
        format = &trace_format_of(line);
      } catch (const UserError& error) {
        throw fail(error.what());
      }
      as = taken(path, *format, reading, notice);
      if (is_trace_header(line)) continue;
    }
    TraceRequest request;
    request.bytes = as.bytes;
    const std::string fault = format->read(line, request);
    if (!fault.empty()) throw fail(fault);
    const double time = request.time_ns;
    if (format->has_cycles) request.time_ns *= as.cycle_ns;
    if (request.time_ns > kLatestTime)
      throw fail(fmt::format("the time is {:g} ns, expected at most {:g} ns", request.time_ns, kLatestTime));
    if (time < latest) {
      throw fail(fmt::format("{} is {}, before {} of an earlier line",
                             format->has_cycles ? "the cycle" : "time_ns", time, latest));
    }
    latest = time;
    if (trace.size() == kMostRequests) throw fail(fmt::format("more than {} requests", kMostRequests));
    trace.push_back(request);
  }
  if (trace.empty()) throw UserError(fmt::format("{}: holds no request", path));
  return trace;
}

}  // namespace parallax
