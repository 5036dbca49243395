// SPDX-License-Identifier: Apache-2.0
// What a Perfetto trace says, by way of protoc.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/cli/program.hpp"
#include "tests/paths.hpp"
#include "tests/traces/tool.hpp"

namespace parallax::test {

/// Slices and counters of a Perfetto trace, from the text that protoc makes of it.
struct Tracks {
  struct Slice {
    std::int64_t begin = 0, end = -1;
    std::string name;
    std::map<std::string, std::string> arguments;  // numbers as text
    std::size_t flows = 0;
  };
  std::map<std::string, std::vector<Slice>> slices;                              // by track
  std::map<std::string, std::vector<std::pair<std::int64_t, double>>> counters;  // likewise

  explicit Tracks(const std::string& text) {
    std::map<std::string, std::string> tracks, events, arguments;
    std::map<std::string, std::vector<std::size_t>> open;
    std::vector<std::string> path;
    std::map<std::string, std::string> fields;  // of the packet, the last value each
    std::vector<std::pair<std::string, std::string>> annotations;
    std::size_t flows = 0;
    for (std::string line : lines(text)) {
      line.erase(0, line.find_first_not_of(' '));
      if (line.back() == '{') {
        path.push_back(line.substr(0, line.size() - 2));
        if (path.back() == "packet") {
          fields.clear();
          annotations.clear();
          flows = 0;
        }
        if (path.back() == "debug_annotations") annotations.emplace_back();
        continue;
      }
      if (line != "}") {
        const std::string key = line.substr(0, line.find(':'));
        std::string value = line.substr(line.find(':') + 2);
        if (value.front() == '"') value = value.substr(1, value.size() - 2);
        if (path.back() == "debug_annotations")
          (key == "name_iid" ? annotations.back().first : annotations.back().second) = value;
        else if (key == "flow_ids")
          ++flows;
        else
          fields[path.back() + "." + key] = value;
        continue;
      }
      const std::string closed = path.back();
      path.pop_back();
      if (closed == "event_names") events[fields["event_names.iid"]] = fields["event_names.name"];
      if (closed == "debug_annotation_names")
        arguments[fields["debug_annotation_names.iid"]] = fields["debug_annotation_names.name"];
      if (closed == "track_descriptor")
        tracks[fields["track_descriptor.uuid"]] = fields["track_descriptor.name"];
      if (closed != "packet" || fields.count("track_event.type") == 0) continue;
      const std::string& type = fields["track_event.type"];
      const std::string& track = tracks.at(fields["track_event.track_uuid"]);
      const std::int64_t time = std::stoll(fields.at("packet.timestamp"));
      if (type == "TYPE_COUNTER") {
        const bool whole = fields.count("track_event.counter_value") != 0;
        counters[track].emplace_back(time, std::stod(fields.at(whole ? "track_event.counter_value"
                                                                     : "track_event.double_counter_value")));
        continue;
      }
      if (type == "TYPE_SLICE_BEGIN") {
        open[track].push_back(slices[track].size());
        slices[track].push_back({time, -1, events.at(fields.at("track_event.name_iid")), {}, flows});
      } else if (!open[track].empty()) {
        slices[track][open[track].back()].end = time;
      }
      // Arguments of its end are the slice's, too.
      if (!open[track].empty()) {
        for (const auto& [name, value] : annotations)
          slices[track][open[track].back()].arguments[arguments.at(name)] = value;
      }
      if (type == "TYPE_SLICE_END" && !open[track].empty()) open[track].pop_back();
    }
  }
};

/// Of a file; needs protoc.
inline Tracks read_tracks(const std::string& pftrace) {
  return Tracks(
      output_of("protoc --decode=Trace -I " + source_path("tests/traces") + " events.proto <" + pftrace));
}

}  // namespace parallax::test
