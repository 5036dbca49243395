// SPDX-License-Identifier: Apache-2.0
#include "traces/vcd_trace.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace parallax {
namespace {

constexpr std::int32_t kStateBits = 3;
constexpr std::int64_t kIdle = 7;  // no firing known, none waited for
constexpr std::int32_t kNumberBits = 32;
// The dates of disparities are known when it is too late for a wave.
constexpr FrameStep kTold[] = {FrameStep::kExposed,  FrameStep::kFirstByte,   FrameStep::kStartable,
                               FrameStep::kInMemory, FrameStep::kCoreStarted, FrameStep::kResultsInMemory,
                               FrameStep::kAtHost};

// Identifier of the n-th signal: printable characters without a blank.
std::string code_of(std::size_t number) {
  constexpr std::size_t kFirst = 33, kCount = 94;
  std::string code;
  do {
    code.push_back(static_cast<char>(kFirst + number % kCount));
    number /= kCount;
  } while (number > 0);
  return code;
}

std::int32_t bits_for(std::uint64_t value) {
  std::int32_t bits = 1;
  while ((value >> bits) != 0) ++bits;
  return bits;
}

std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', begin)) {
    parts.push_back(path.substr(begin, dot - begin));
    begin = dot + 1;
  }
  parts.push_back(path.substr(begin));
  return parts;
}

}  // namespace

VcdTrace::SignalId VcdTrace::declare(const std::string& scope, const std::string& name, std::int32_t width) {
  Signal signal;
  signal.code = code_of(signals_.size());
  signal.width = width;
  const std::string range = width > 1 ? fmt::format(" [{}:0]", width - 1) : "";
  declarations_.emplace_back(scope,
                             fmt::format("$var wire {} {} {}{} $end\n", width, signal.code, name, range));
  signals_.push_back(std::move(signal));
  return signals_.size() - 1;
}

void VcdTrace::begin(const TraceParts& parts) {
  parts_ = parts;
  for (const TraceParts::StagePart& stage : parts.stages) {
    stages_.push_back({declare(stage.path, "state", kStateBits), declare(stage.path, "waited", kStateBits),
                       declare(stage.path, "frame", kNumberBits), declare(stage.path, "row", kNumberBits)});
    signals_[stages_.back().state].value = kIdle;
  }
  for (const TraceParts::StreamPart& stream : parts.streams) {
    streams_.push_back({declare(stream.path, "write", 1), declare(stream.path, "read", 1),
                        declare(stream.path, "level", bits_for(stream.depth))});
  }
  for (const TraceParts::PortPart& port : parts.ports) {
    ports_.push_back({declare(port.path, "row", kNumberBits), declare(port.path, "requests", kNumberBits)});
  }
  for (const FrameStep step : kTold) {
    steps_[index_of(step)] = declare("frames", name_of(step), kNumberBits);
  }
  std::stable_sort(declarations_.begin(), declarations_.end(),
                   [](const auto& a, const auto& b) { return parts_of(a.first) < parts_of(b.first); });
  out_.add(std::string_view("$timescale 1 ps $end\n"));
  out_.add(fmt::format(
      "$comment state: 0 busy, 5 overhead, 7 neither; of a machine that is stuck, at the end: 1 upstream "
      "empty, 2 downstream "
      "full; waited, when a wait is over: 0 not, 1 upstream empty, 2 downstream full, 3 memory, 4 "
      "synchroniser, 5 blanking; "
      "level {}; frames: how many have come so far $end\n",
      parts.tokens ? "tokens: write and read are high in the cycles in which a token passes"
                   : "rows: write and read are high when tokens passed in the row's time before"));
  std::vector<std::string> open;
  for (const auto& [scope, line] : declarations_) {
    const std::vector<std::string> wanted = parts_of(scope);
    std::size_t common = 0;
    while (common < open.size() && common < wanted.size() && open[common] == wanted[common]) ++common;
    for (; open.size() > common; open.pop_back()) out_.add(std::string_view("$upscope $end\n"));
    for (; open.size() < wanted.size(); open.push_back(wanted[open.size()])) {
      out_.add(fmt::format("$scope module {} $end\n", wanted[open.size()]));
    }
    out_.add(line);
  }
  for (; !open.empty(); open.pop_back()) out_.add(std::string_view("$upscope $end\n"));
  out_.add(std::string_view("$enddefinitions $end\n#0\n$dumpvars\n"));
  for (Signal& signal : signals_) {
    append(signal);
    signal.dumped = signal.value;
  }
  out_.add(std::string_view("$end\n"));
  declarations_.clear();
}

void VcdTrace::append(const Signal& signal) {
  if (signal.width == 1) {
    out_.add(signal.value != 0 ? '1' : '0');
  } else {
    out_.add('b');
    std::int32_t bit = signal.width - 1;
    while (bit > 0 && ((signal.value >> bit) & 1) == 0) --bit;  // leading zeros are left out
    for (; bit >= 0; --bit) out_.add(((signal.value >> bit) & 1) != 0 ? '1' : '0');
    out_.add(' ');
  }
  out_.add(signal.code);
  out_.add('\n');
}

// Writes what has changed at time_.
void VcdTrace::dump() {
  bool stamped = false;
  for (const SignalId id : changed_) {
    Signal& signal = signals_[id];
    signal.changed = false;
    if (signal.value == signal.dumped) continue;
    if (!stamped) {
      out_.add('#');
      out_.add(time_);
      out_.add('\n');
      stamped = true;
    }
    append(signal);
    signal.dumped = signal.value;
  }
  changed_.clear();
}

void VcdTrace::set(SignalId id, std::int64_t value) {
  Signal& signal = signals_[id];
  signal.value = value;
  if (!signal.changed) changed_.push_back(id);
  signal.changed = true;
}

// Goes on to `time`, past the changes that come by themselves until then.
void VcdTrace::advance(std::int64_t time) {
  for (; !later_.empty() && later_.date() <= time; later_.pop()) {
    const Later& next = later_.front();
    if (next.time > time_) {
      dump();
      time_ = next.time;
    }
    set(next.signal, next.value);
  }
  if (time > time_) {
    dump();
    time_ = time;
  }
}

void VcdTrace::change(Picoseconds time, SignalId signal, std::int64_t value) {
  advance(time.count());
  set(signal, value);
}

void VcdTrace::change_later(Picoseconds time, SignalId signal, std::int64_t value) {
  later_.push({time.count(), signal, value});
}

void VcdTrace::row_begins(const RowBegin& row) {
  const StageSignals& stage = stages_[row.stage];
  change(row.begin, stage.frame, row.position.frame + 1);
  change(row.begin, stage.row, row.position.row);
  if (!parts_.tokens) change(row.begin, stage.state, index_of(StageActivity::kBusy));
}

void VcdTrace::row(const StageRow& row) {
  if (parts_.tokens) return;
  const StageSignals& stage = stages_[row.stage];
  change(row.end, stage.state, kIdle);
  change(row.end, stage.waited, index_of(row.longest_wait));
}

void VcdTrace::fifo(const FifoSpan& span) {
  if (parts_.tokens) return;
  const StreamSignals& stream = streams_[span.stream];
  const Picoseconds now = std::max(span.end, Picoseconds(time_));  // spans may come late
  change(now, stream.write, span.written > 0 ? 1 : 0);
  change(now, stream.read, span.freed > 0 ? 1 : 0);
  change(now, stream.level, span.level);
}

void VcdTrace::port_row(const PortRow& row) { change(row.end, ports_[row.port].row, row.position.row); }

void VcdTrace::frame_step(std::int64_t frame, FrameStep step, Picoseconds time) {
  change(time, steps_[index_of(step)], frame + 1);
}

void VcdTrace::firing(const StageFiring& firing) {
  const StageSignals& stage = stages_[firing.stage];
  change(firing.start, stage.state, index_of(firing.work));
  change_later(firing.end, stage.state, kIdle);
  const bool for_input = firing.ready - firing.free >= firing.start - firing.ready;
  const StageActivity wait = firing.start == firing.free ? StageActivity::kBusy
                             : for_input                 ? firing.input_wait
                                                         : firing.room_wait;
  change(firing.start, stage.waited, index_of(wait));
}

void VcdTrace::token(const TokenTransfer& token) {
  const StreamSignals& stream = streams_[token.stream];
  const SignalId signal = token.read ? stream.read : stream.write;
  change(token.begin, signal, 1);
  change_later(token.end, signal, 0);
  change_later(token.end, stream.level, token.level);
}

void VcdTrace::requests(const PortRequests& requests) {
  change(requests.time, ports_[requests.port].requests, requests.under_way);
}

void VcdTrace::end(Picoseconds time, const std::vector<EndlessWait>& waits) {
  for (const EndlessWait& wait : waits) {
    for (std::size_t stage = 0; stage < parts_.stages.size(); ++stage) {
      if (parts_.stages[stage].path != wait.waiter) continue;
      change(std::max(time, Picoseconds(time_)), stages_[stage].state,
             index_of(wait.on_full ? StageActivity::kBlocked : StageActivity::kStarved));
    }
  }
  advance(std::max(time.count(), time_));
  while (!later_.empty()) advance(later_.date());
  dump();
  out_.write();
}

}  // namespace parallax
