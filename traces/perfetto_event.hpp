// SPDX-License-Identifier: Apache-2.0
// A packet with a TrackEvent, field by field as they go into the file: what a trace consists of but for a few
// packets.
#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>

#include "tlm/units.hpp"
#include "traces/text_buffer.hpp"

namespace parallax {

/// Numbers of fields in perfetto's trace_packet.proto, track_event.proto, track_descriptor.proto,
/// interned_data.proto and debug_annotation.proto.
namespace perfetto_field {
constexpr std::uint32_t kPacket = 1;
constexpr std::uint32_t kTimestamp = 8, kSequence = 10, kTrackEvent = 11, kInternedData = 12,
                        kSequenceFlags = 13, kTrackDescriptor = 60;
constexpr std::uint32_t kEventNames = 2, kAnnotationNames = 3, kEntryNumber = 1, kEntryName = 2;
constexpr std::uint32_t kUuid = 1, kName = 2, kProcess = 3, kParent = 5, kCounter = 8;
constexpr std::uint32_t kPid = 1, kProcessName = 6, kUnitName = 6;
constexpr std::uint32_t kAnnotation = 4, kType = 9, kNameNumber = 10, kTrack = 11, kCounterValue = 30,
                        kDoubleCounterValue = 44, kFlow = 47;
constexpr std::uint32_t kAnnotationName = 1, kIntValue = 4, kStringValue = 6;
}  // namespace perfetto_field

/// Writes one TrackEvent; complete when it is destroyed.
class PerfettoEvent {
 public:
  enum class Type : std::uint8_t { kSliceBegin = 1, kSliceEnd = 2, kCounter = 4 };
  static constexpr std::uint32_t kOurSequence = 1;
  static constexpr std::uint32_t kNeedsState = 2;

  PerfettoEvent(TextBuffer& out, Picoseconds time, Type type, std::uint64_t track)
      : out_(out), at_(out.room(kMost)) {
    packet_ = begin(perfetto_field::kPacket);
    add(perfetto_field::kTimestamp, time.count());
    add(perfetto_field::kSequence, kOurSequence);
    add(perfetto_field::kSequenceFlags, kNeedsState);
    event_ = begin(perfetto_field::kTrackEvent);
    add(perfetto_field::kType, static_cast<std::uint64_t>(type));
    add(perfetto_field::kTrack, track);
  }
  ~PerfettoEvent() {
    end(event_);
    end(packet_);
    out_.added_until(at_);
  }
  PerfettoEvent(const PerfettoEvent&) = delete;
  PerfettoEvent& operator=(const PerfettoEvent&) = delete;

  void name(std::uint64_t number) { add(perfetto_field::kNameNumber, number); }
  void flow(std::uint64_t id) { add_fixed(perfetto_field::kFlow, id); }
  void counter(std::int64_t value) { add(perfetto_field::kCounterValue, value); }
  void counter(std::uint64_t value) { counter(static_cast<std::int64_t>(value)); }
  void counter(double value) {
    std::uint64_t bits = 0;
    static_assert(sizeof bits == sizeof value);
    std::memcpy(&bits, &value, sizeof bits);
    add_fixed(perfetto_field::kDoubleCounterValue, bits);
  }
  void argument(std::uint64_t name_number, std::int64_t value) {
    char* const length = begin(perfetto_field::kAnnotation);
    add(perfetto_field::kAnnotationName, name_number);
    add(perfetto_field::kIntValue, value);
    end(length);
  }
  void argument(std::uint64_t name_number, std::string_view text) {
    char* const length = begin(perfetto_field::kAnnotation);
    add(perfetto_field::kAnnotationName, name_number);
    text = text.substr(0, kLongestText);
    key(perfetto_field::kStringValue, 2);
    varint(text.size());
    std::memcpy(at_, text.data(), text.size());
    at_ += text.size();
    end(length);
  }

 private:
  static constexpr std::size_t kMost = 4096;  // bytes of an event: some twenty arguments
  static constexpr std::size_t kLongestText = 120;
  static constexpr std::size_t kLengthBytes = 2;

  void varint(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) *at_++ = static_cast<char>(value | 0x80);
    *at_++ = static_cast<char>(value);
  }
  void key(std::uint32_t field, std::uint32_t wire_type) { varint(field << 3 | wire_type); }
  void add(std::uint32_t field, std::uint64_t value) {
    key(field, 0);
    varint(value);
  }
  void add_fixed(std::uint32_t field, std::uint64_t bits) {
    key(field, 1);
    for (int i = 0; i < 8; ++i) *at_++ = static_cast<char>(bits >> (8 * i));
  }
  // A message in a message: its length comes before it and is known afterwards. A varint may be longer than
  // it need be.
  char* begin(std::uint32_t field) {
    key(field, 2);
    char* const length = at_;
    at_ += kLengthBytes;
    return length;
  }
  void end(char* length) {
    const std::size_t bytes = at_ - length - kLengthBytes;
    length[0] = static_cast<char>(bytes | 0x80);
    length[1] = static_cast<char>(bytes >> 7);
  }

  TextBuffer& out_;
  char* at_;
  char* packet_;
  char* event_;
};

}  // namespace parallax
