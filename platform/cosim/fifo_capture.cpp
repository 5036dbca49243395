// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/fifo_capture.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string_view>

#include "platform/config/nearest_name.hpp"
#include "platform/cosim/fifo_bench.hpp"
#include "platform/cosim/vcd_waves.hpp"
#include "platform/input/text_file.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

// Signals of a FIFO by role, in the places of these; of VCD and CSV alike.
enum FifoPlace : std::size_t {
  kWriteGrant,
  kWriteWant,
  kReadGrant,
  kReadWant,
  kReset,
  kWriteClock,
  kReadClock,
  kPlaces
};

struct FifoColumn {
  std::size_t index = 0;  // among what there is
  std::string name;
  char active = '1';
};
using FifoColumns = std::array<std::optional<FifoColumn>, kPlaces>;

// What a file has of a FIFO. `index_of` finds a name among what there is.
class FifoLookup {
 public:
  using Find = std::function<std::optional<std::size_t>(const std::string& name)>;

  FifoLookup(const std::string& path, const FifoSignals& signals, std::vector<std::string> names, Find find)
      : path_(path), signals_(signals), names_(std::move(names)), find_(std::move(find)) {}

  FifoColumns columns(bool has_clocks) const {
    FifoColumns all;
    all[kWriteGrant] = either("write_ready", '1', "full", '0', true);
    all[kWriteWant] = either("write_valid", '1', nullptr, '1', true);
    all[kReadGrant] = either("read_valid", '1', "empty", '0', true);
    all[kReadWant] = either("read_ready", '1', nullptr, '1', true);
    all[kReset] = either("reset", '1', "reset_n", '0', false);
    if (!has_clocks) return all;
    if (signals_.clock.empty()) {
      all[kWriteClock] = of("write_clock", '1');
      all[kReadClock] = of("read_clock", '1');
      if (all[kWriteClock] && all[kReadClock]) return all;
    }
    all[kWriteClock] = all[kReadClock] = either("clock", '1', nullptr, '1', true);
    return all;
  }

 private:
  static const FifoSignals::Role& role(const char* name) {
    return *std::find_if(FifoSignals::roles().begin(), FifoSignals::roles().end(),
                         [&](const FifoSignals::Role& each) { return std::string_view(each.name) == name; });
  }
  UserError missing(const std::string& name, const char* role) const {
    if (names_.empty()) return UserError(fmt::format("{}: no signals in this file", path_));
    return UserError(fmt::format(
        "{}: no signal {} for {}; the nearest is {}; {}", path_, excerpt(name), role,
        excerpt(nearest_name(name, names_)),
        is_of_bench() ? "these are waves of parallax fifo --bench, whose names are known: leave --signals out"
                      : fmt::format("--signals {}=NAME names another one", role)));
  }
  // None has a name by which it is looked for.
  UserError none_usual(const char* one, const char* other) const {
    if (names_.empty()) return UserError(fmt::format("{}: no signals in this file", path_));
    std::string text =
        fmt::format("{}: no signal is called {}, for {}", path_, fmt::join(role(one).usual, " or "), one);
    if (other != nullptr)
      text += fmt::format(", nor {}, for {}", fmt::join(role(other).usual, " or "), other);
    return UserError(fmt::format("{}; --signals {}=NAME{} names it", text, one,
                                 other == nullptr ? "" : fmt::format(" or {}=NAME", other)));
  }
  // Whether a test bench that is written here has made them.
  bool is_of_bench() const {
    const std::string scope = fmt::format("{}.", kFifoBench);
    return std::any_of(names_.begin(), names_.end(),
                       [&](const std::string& name) { return name.find(scope) != std::string::npos; });
  }

  std::optional<FifoColumn> of(const char* name, char active) const {
    const std::string& asked = signals_.*role(name).signal;
    if (!asked.empty()) {
      if (const auto found = find_(asked)) return FifoColumn{*found, asked, active};
      throw missing(asked, name);
    }
    for (const std::string& usual : role(name).usual) {
      if (const auto found = find_(usual)) return FifoColumn{*found, usual, active};
    }
    return std::nullopt;
  }

  // By one role or by the other, that which was asked for first.
  std::optional<FifoColumn> either(const char* one, char active, const char* other, char other_active,
                                   bool needed) const {
    const bool other_asked = other != nullptr && !(signals_.*role(other).signal).empty();
    if (!other_asked) {
      if (auto found = of(one, active)) return found;
    }
    if (other != nullptr) {
      if (auto found = of(other, other_active)) return found;
    }
    if (needed) throw none_usual(one, other);
    return std::nullopt;
  }

  const std::string& path_;
  const FifoSignals& signals_;
  const std::vector<std::string> names_;
  const Find find_;
};

// Notes what the signals are at the edges, from the first one on at which reset is over.
class FifoRecorder {
 public:
  using Values = std::array<char, kPlaces>;

  FifoRecorder(const std::string& path, FifoColumns columns) : columns_(std::move(columns)) {
    capture_.file = path;
  }

  void edge(bool of_writer, std::int64_t time, const Values& values) {
    FifoSide& side = of_writer ? capture_.write : capture_.read;
    if (columns_[kReset]) {
      if (values[kReset] == columns_[kReset]->active || (values[kReset] != '0' && values[kReset] != '1')) {
        if (side.edges.empty()) return;
        throw UserError(
            fmt::format("{}: {} resets the FIFO again in cycle {}; one run after one reset is described",
                        capture_.file, columns_[kReset]->name, side.edges.size()));
      }
    }
    const auto is_active = [&](FifoPlace place) {
      const char value = values[place];
      if (value != '0' && value != '1') {
        throw UserError(fmt::format("{}: {} is unknown ({}) in cycle {}{}", capture_.file,
                                    columns_[place]->name, value == '\0' ? 'x' : value, side.edges.size(),
                                    columns_[kReset]
                                        ? " after reset"
                                        : "; --signals reset=NAME or reset_n=NAME says when it is over"));
      }
      return value == columns_[place]->active;
    };
    side.granted.push_back(is_active(of_writer ? kWriteGrant : kReadGrant));
    side.wanted.push_back(is_active(of_writer ? kWriteWant : kReadWant));
    side.edges.push_back(time);
  }

  FifoCapture take() {
    if (capture_.write.edges.empty() || capture_.read.edges.empty()) {
      throw UserError(fmt::format("{}: no rising edge of the {} clock{}", capture_.file,
                                  capture_.write.edges.empty() ? "write" : "read",
                                  columns_[kReset] ? " after " + columns_[kReset]->name : ""));
    }
    return std::move(capture_);
  }
  FifoCapture& capture() { return capture_; }

 private:
  const FifoColumns columns_;
  FifoCapture capture_;
};

FifoCapture capture_of_vcd(const std::string& text, const std::string& path, const FifoSignals& asked) {
  VcdWaves waves(text, path);
  std::vector<std::string> names;
  for (const VcdWaves::Signal& signal : waves.signals()) names.push_back(signal.name);
  const FifoColumns columns =
      FifoLookup(path, asked, names, [&](const std::string& name) {
        const VcdWaves::Signal* const found = waves.find(name);
        return found == nullptr ? std::nullopt : std::optional<std::size_t>(found - waves.signals().data());
      }).columns(true);
  std::vector<const VcdWaves::Signal*> watched;
  std::vector<std::size_t> places;
  for (std::size_t place = 0; place < kPlaces; ++place) {
    if (!columns[place]) continue;
    const VcdWaves::Signal& signal = waves.signals()[columns[place]->index];
    if (signal.width != 1)
      throw UserError(fmt::format("{}: {} has {} bits, it should have 1", path, signal.name, signal.width));
    watched.push_back(&signal);
    places.push_back(place);
  }
  FifoRecorder recorder(path, columns);
  recorder.capture().two_clocks = watched[places.size() - 1]->ids != watched[places.size() - 2]->ids;
  FifoRecorder::Values values{};
  waves.read(watched, [&](std::int64_t time, const VcdWaves::Changes& changes) {
    FifoRecorder::Values after = values;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (changes[i] != nullptr) after[places[i]] = changes[i]->back();
    }
    for (const bool of_writer : {true, false}) {
      const std::size_t clock = of_writer ? kWriteClock : kReadClock;
      if (values[clock] == '0' && after[clock] == '1') recorder.edge(of_writer, time, values);
    }
    values = after;
  });
  return recorder.take();
}

std::vector<std::string> comma_separated(std::string_view line) {
  std::vector<std::string> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    std::string_view cell = line.substr(0, comma);
    while (!cell.empty() && std::string_view(" \t\r\"").find(cell.front()) != std::string_view::npos)
      cell.remove_prefix(1);
    while (!cell.empty() && std::string_view(" \t\r\"").find(cell.back()) != std::string_view::npos)
      cell.remove_suffix(1);
    cells.emplace_back(cell);
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

FifoCapture capture_of_csv(std::string_view text, const std::string& path, const FifoSignals& asked) {
  std::vector<std::string> head;
  std::optional<FifoRecorder> recorder;
  FifoColumns columns;
  std::int64_t cycle = 0;
  for (std::int64_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    const std::vector<std::string> cells = comma_separated(line);
    if (!recorder) {
      head = cells;
      columns =
          FifoLookup(path, asked, head, [&](const std::string& name) {
            const auto found = std::find(head.begin(), head.end(), name);
            return found == head.end() ? std::nullopt : std::optional<std::size_t>(found - head.begin());
          }).columns(false);
      recorder.emplace(path, columns);
      continue;
    }
    if (cells.size() != head.size())
      throw UserError(
          fmt::format("{}, line {}: {} columns in place of {}", path, number, cells.size(), head.size()));
    FifoRecorder::Values values{};
    for (std::size_t place = 0; place < kPlaces; ++place) {
      if (!columns[place]) continue;
      const std::string& cell = cells[columns[place]->index];
      if (cell.size() != 1) {
        throw UserError(fmt::format("{}, line {}: {} is '{}', it should be 0 or 1", path, number,
                                    columns[place]->name, excerpt(cell)));
      }
      values[place] = cell.front();
    }
    for (const bool of_writer : {true, false}) recorder->edge(of_writer, cycle, values);
    ++cycle;
  }
  if (!recorder) throw UserError(fmt::format("{}: the file is empty", path));
  return recorder->take();
}

}  // namespace

FifoCapture read_fifo_capture(const std::string& path, const FifoSignals& signals) {
  const std::string text = read_text_file(path);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && text[first] == '$') return capture_of_vcd(text, path, signals);
  return capture_of_csv(text, path, signals);
}

}  // namespace parallax
