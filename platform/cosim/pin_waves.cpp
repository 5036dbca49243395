// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/pin_waves.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <string_view>
#include <utility>

#include "traces/perfetto_writer.hpp"

namespace parallax {
namespace {

// A name for a signal that is as short as can be: of printable characters.
std::string identifier(std::size_t number) {
  std::string text;
  do {
    text += static_cast<char>('!' + number % 94);
    number /= 94;
  } while (number > 0);
  return text;
}

// In a name nothing may stand that ends it.
std::string one_word(std::string name) {
  for (char& c : name) {
    if (c == ' ' || c == '\t' || c == '\n') c = '_';
  }
  return name;
}

class VcdText {
 public:
  explicit VcdText(const PinWaves& waves) : waves_(waves), last_(waves.signals.size()) {
    text_ = fmt::format("$comment {}; in the cycle from {} ps on $end\n$timescale 1 ps $end\n", waves.title,
                        waves.at.count());
    std::map<std::string, std::string> scopes;  // with what is declared in each
    const auto declare = [&scopes](const PinWaves::Signal& signal, std::size_t number) {
      scopes[signal.scope] +=
          fmt::format("$var wire {} {} {} $end\n", signal.width, identifier(number), one_word(signal.name));
    };
    if (has_clock()) declare(waves.clock, kClock);
    for (std::size_t i = 0; i < waves.signals.size(); ++i) declare(waves.signals[i], i + 1);
    for (const auto& [scope, declarations] : scopes)
      text_ += fmt::format("$scope module {} $end\n{}$upscope $end\n", one_word(scope), declarations);
    text_ += "$enddefinitions $end\n";
  }

  std::string write() {
    for (const PinWaves::Cycle& cycle : waves_.cycles) add(cycle);
    return std::move(text_);
  }

 private:
  static constexpr std::size_t kClock = 0;

  bool has_clock() const { return !waves_.clock.name.empty(); }

  void set_clock(bool high) {
    if (has_clock()) text_ += fmt::format("{}{}\n", high ? 1 : 0, identifier(kClock));
  }

  // The date at which a cycle ends is that at which the next one begins.
  void date(Picoseconds time) {
    if (time.count() == now_) return;
    now_ = time.count();
    text_ += fmt::format("#{}\n", now_);
  }

  void add(const PinWaves::Cycle& cycle) {
    date(cycle.begin);
    if (&cycle == &waves_.cycles.front()) set_clock(cycle.edge_before);
    for (std::size_t i = 0; i < cycle.values.size(); ++i) {
      const std::string& value = cycle.values[i];
      if (value == last_[i]) continue;
      last_[i] = value;
      text_ += waves_.signals[i].width == 1 ? value + identifier(i + 1) + "\n"
                                            : fmt::format("b{} {}\n", value, identifier(i + 1));
    }
    if (cycle.edge_before) {
      date(Picoseconds((cycle.begin.count() + cycle.end.count()) / 2));
      set_clock(false);
    }
    date(cycle.end);
    if (cycle.edge_after) set_clock(true);
  }

  const PinWaves& waves_;
  std::vector<std::string> last_;
  std::string text_;
  std::int64_t now_ = -1;
};

std::string hex(const std::string& binary) {
  if (binary.find('x') != std::string::npos) return "x";
  std::string text;
  const std::string padded = std::string((4 - binary.size() % 4) % 4, '0') + binary;
  for (std::size_t i = 0; i < padded.size(); i += 4)
    text += "0123456789abcdef"[std::stoul(padded.substr(i, 4), nullptr, 2)];
  return text;
}

// Of one signal, the values that it has and until when.
void add_track(PerfettoWriter& out, const PinWaves& waves, std::size_t signal,
               std::map<std::string, std::uint64_t>& names) {
  const bool one_bit = waves.signals[signal].width == 1;
  const PerfettoWriter::Track track =
      out.add_track(waves.signals[signal].scope + "." + waves.signals[signal].name, one_bit ? "" : nullptr);
  const std::vector<PinWaves::Cycle>& cycles = waves.cycles;
  for (std::size_t first = 0, next = 0; first < cycles.size(); first = next) {
    const std::string& value = cycles[first].values[signal];
    do {
      ++next;
    } while (next < cycles.size() && cycles[next].values[signal] == value &&
             cycles[next].begin == cycles[next - 1].end);
    if (one_bit) {
      out.counter(track, cycles[first].begin, std::int64_t{value == "1" ? 1 : 0});
    } else {
      std::uint64_t& name = names[value];
      if (name == 0) name = out.add_event_name(hex(value));
      out.slice(track, cycles[first].begin, cycles[next - 1].end, name);
    }
  }
}

}  // namespace

std::string to_vcd(const PinWaves& waves) { return VcdText(waves).write(); }

std::string to_perfetto(const PinWaves& waves) {
  std::string bytes;
  PerfettoWriter out([&bytes](std::string_view more) { bytes += more; });
  out.begin();
  const PerfettoWriter::Track happened = out.add_track("what happened");
  for (const PinWaves::Cycle& cycle : waves.cycles) {
    if (cycle.begin == waves.at) out.slice(happened, cycle.begin, cycle.end, out.add_event_name(waves.title));
  }
  std::map<std::string, std::uint64_t> names;
  for (std::size_t i = 0; i < waves.signals.size(); ++i) add_track(out, waves, i, names);
  out.write();
  return bytes;
}

}  // namespace parallax
