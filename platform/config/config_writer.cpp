// SPDX-License-Identifier: Apache-2.0
#include "platform/config/config_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

namespace parallax {
namespace {

constexpr std::size_t kCommentColumns = 100;

/// Sections in the order of their first key: TOML opens each one once.
std::vector<std::string> sections_of(const std::vector<EffectiveKey>& keys) {
  std::vector<std::string> sections;
  for (const EffectiveKey& key : keys) {
    if (std::find(sections.begin(), sections.end(), key.section) == sections.end()) {
      sections.push_back(key.section);
    }
  }
  return sections;
}

std::string comment(const std::string& text) {
  std::istringstream words(text);
  std::string lines, line = "#";
  for (std::string word; words >> word;) {
    if (line.size() + 1 + word.size() > kCommentColumns) {
      lines += line + "\n";
      line = "#";
    }
    line += " " + word;
  }
  return lines + line + "\n";
}

std::string documented_entry(const EffectiveKey& key) {
  const std::string unit = key.unit.empty() ? "" : ", unit: " + key.unit;
  return "\n" + comment(key.documentation) + comment("Allowed: " + key.expected + unit + ".") +
         fmt::format("{} = {{ value = {}, tag = \"{}\", source = {} }}\n", key.name, to_toml(key.value),
                     static_cast<char>(key.provenance.tag), to_toml(ConfigValue(key.provenance.source)));
}

std::string plain_entry(const EffectiveKey& key) {
  const std::string entry = key.name + " = " + to_toml(key.value);
  return key.unit.empty() ? entry + "\n" : fmt::format("{:<32} # {}\n", entry, key.unit);
}

nlohmann::ordered_json to_json(const ConfigValue& value) {
  return std::visit([](const auto& held) { return nlohmann::ordered_json(held); }, value);
}

nlohmann::ordered_json documented_json(const EffectiveKey& key) {
  return {{"value", to_json(key.value)},
          {"unit", key.unit},
          {"allowed", key.expected},
          {"documentation", key.documentation},
          {"tag", std::string(1, static_cast<char>(key.provenance.tag))},
          {"source", key.provenance.source}};
}

}  // namespace

std::string to_toml(const Configuration& configuration, bool documented) {
  std::string text = fmt::format(
      "description = {}\n", to_toml(ConfigValue("the effective configuration of " + configuration.preset)));
  for (const std::string& section : sections_of(configuration.keys)) {
    text += fmt::format("\n[{}]\n", section);
    for (const EffectiveKey& key : configuration.keys) {
      if (key.section == section) text += documented ? documented_entry(key) : plain_entry(key);
    }
  }
  return text;
}

nlohmann::ordered_json to_json(const Configuration& configuration, bool documented) {
  nlohmann::ordered_json tree;
  tree["preset"] = configuration.preset;
  for (const EffectiveKey& key : configuration.keys) {
    nlohmann::ordered_json* place = &tree[key.section];
    std::istringstream name(key.name);
    for (std::string part; std::getline(name, part, '.');) place = &(*place)[part];
    *place = documented ? documented_json(key) : to_json(key.value);
  }
  return tree;
}

}  // namespace parallax
