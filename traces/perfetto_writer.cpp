// SPDX-License-Identifier: Apache-2.0
#include "traces/perfetto_writer.hpp"

#include <protozero/pbf_writer.hpp>

namespace parallax {
namespace {

namespace field = perfetto_field;

constexpr std::uint64_t kProcessTrack = 1;
constexpr std::uint32_t kStateCleared = 1;

}  // namespace

void PerfettoWriter::add_packet(std::string_view packet) {
  std::string bytes;
  protozero::pbf_writer(bytes).add_message(field::kPacket, packet.data(), packet.size());
  out_.add(bytes);
}

void PerfettoWriter::begin() {
  std::string bytes;
  {
    protozero::pbf_writer packet(bytes);
    packet.add_uint32(field::kSequence, PerfettoEvent::kOurSequence);
    packet.add_uint32(field::kSequenceFlags, kStateCleared);
    protozero::pbf_writer descriptor(packet, field::kTrackDescriptor);
    descriptor.add_uint64(field::kUuid, kProcessTrack);
    protozero::pbf_writer process(descriptor, field::kProcess);
    process.add_int32(field::kPid, 1);
    process.add_string(field::kProcessName, "Parallax: 1 ns shown is 1 ps, so 1 s is 1 ms");
  }
  add_packet(bytes);
}

PerfettoWriter::Track PerfettoWriter::add_track(const std::string& name, const char* unit) {
  const Track track = ++last_track_;
  std::string bytes;
  {
    protozero::pbf_writer packet(bytes);
    packet.add_uint32(field::kSequence, PerfettoEvent::kOurSequence);
    protozero::pbf_writer descriptor(packet, field::kTrackDescriptor);
    descriptor.add_uint64(field::kUuid, track);
    descriptor.add_string(field::kName, name);
    descriptor.add_uint64(field::kParent, kProcessTrack);
    if (unit != nullptr) {
      protozero::pbf_writer counter(descriptor, field::kCounter);
      counter.add_string(field::kUnitName, unit);
    }
  }
  add_packet(bytes);
  return track;
}

void PerfettoWriter::add_name(std::uint32_t list, std::uint64_t number, std::string_view name) {
  std::string bytes;
  {
    protozero::pbf_writer packet(bytes);
    packet.add_uint32(field::kSequence, PerfettoEvent::kOurSequence);
    packet.add_uint32(field::kSequenceFlags, PerfettoEvent::kNeedsState);
    protozero::pbf_writer data(packet, field::kInternedData);
    protozero::pbf_writer entry(data, list);
    entry.add_uint64(field::kEntryNumber, number);
    entry.add_string(field::kEntryName, name.data(), name.size());
  }
  add_packet(bytes);
}

std::uint64_t PerfettoWriter::add_event_name(std::string_view name) {
  add_name(field::kEventNames, ++last_event_name_, name);
  return last_event_name_;
}

std::uint64_t PerfettoWriter::add_argument_name(std::string_view name) {
  add_name(field::kAnnotationNames, ++last_argument_name_, name);
  return last_argument_name_;
}

}  // namespace parallax
