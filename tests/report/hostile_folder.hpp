// SPDX-License-Identifier: Apache-2.0
// The folder of a run as somebody who means harm would send it: each name and text tries to become an element
// of the page. The elements are harmless, and of the class "marker".
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/program.hpp"

namespace parallax::test {

inline const std::string kHostileName = "\"'><b class=marker>";
inline const std::string kHostileText = "</script><!--<script>'\"><b class=marker>&lt;\xE2\x80\xA8";

// The paths at whose end a name of the folder's own stands.
inline bool is_name(const std::string& parent, const nlohmann::ordered_json& entry) {
  if (parent == "/stages" || parent == "/streams" || parent == "/frame/bandwidth" || parent == "/latency")
    return true;
  return parent == "/memory" && entry.is_object() && !entry.contains("value");
}

inline nlohmann::ordered_json hostile(const nlohmann::ordered_json& tree, const std::string& path = "") {
  using Json = nlohmann::ordered_json;
  if (tree.is_string() && tree.get<std::string>().empty()) return tree;  // a unit that there is none of
  if (tree.is_string()) {
    const bool names = path.find("/writer/value") != std::string::npos ||
                       path.find("/reader/value") != std::string::npos ||
                       path.find("/part/value") != std::string::npos;
    return tree.get<std::string>() + (names ? kHostileName : kHostileText);
  }
  if (tree.is_array()) {
    Json list = Json::array();
    for (const Json& entry : tree) list.push_back(hostile(entry, path));
    return list;
  }
  if (!tree.is_object()) return tree;
  Json changed = Json::object();
  for (const auto& [key, entry] : tree.items()) {
    const bool is_schema = path.empty() && key == "schema";
    // In timing.json the spans of a frame's latency are numbers of their own names; in the profile they are
    // lists.
    const bool renamed = is_name(path, entry) && !(path == "/latency" && entry.contains("unit"));
    changed[renamed ? key + kHostileName : key] = is_schema ? entry : hostile(entry, path + "/" + key);
  }
  return changed;
}

/// Makes the results in `folder` hostile.
inline void make_hostile(const Program& program, const std::string& folder) {
  for (const char* name : {"timing.json", "profile.json", "relaxations.json"}) {
    const std::string path = folder + "/" + name;
    program.folder().write(path, hostile(nlohmann::ordered_json::parse(program.read(path))).dump());
  }
}

}  // namespace parallax::test
