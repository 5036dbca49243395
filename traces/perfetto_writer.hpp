// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "traces/perfetto_event.hpp"
#include "traces/text_buffer.hpp"

namespace parallax {

/// Writes Perfetto's TrackEvent packets (protobuf; opens in ui.perfetto.dev and trace_processor). Time there
/// is in whole nanoseconds, so that 1 "ns" is 1 ps: the process says so by its name.
class PerfettoWriter {
 public:
  using Track = std::uint64_t;
  using Type = PerfettoEvent::Type;

  explicit PerfettoWriter(ByteSink sink) : out_(std::move(sink)) {}

  /// First of all.
  void begin();
  Track add_track(const std::string& name, const char* unit = nullptr);
  /// Names of events and of their arguments go into the file once, and are numbers from then on: 1, 2, ...
  std::uint64_t add_event_name(std::string_view name);
  std::uint64_t add_argument_name(std::string_view name);

  PerfettoEvent event(Picoseconds time, Type type, Track track) { return {out_, time, type, track}; }
  void slice_end(Track track, Picoseconds time) { event(time, Type::kSliceEnd, track); }
  void slice(Track track, Picoseconds begin, Picoseconds end, std::uint64_t name) {
    event(begin, Type::kSliceBegin, track).name(name);
    slice_end(track, end);
  }
  template <class Value>
  void counter(Track track, Picoseconds time, Value value) {
    event(time, Type::kCounter, track).counter(value);
  }
  /// Hands over what has been collected.
  void write() { out_.write(); }

 private:
  void add_packet(std::string_view packet);
  void add_name(std::uint32_t list, std::uint64_t number, std::string_view name);

  TextBuffer out_;
  Track last_track_ = 1;  // 1 is the process
  std::uint64_t last_event_name_ = 0, last_argument_name_ = 0;
};

}  // namespace parallax
