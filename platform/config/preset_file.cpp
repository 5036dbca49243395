// SPDX-License-Identifier: Apache-2.0
#include "platform/config/preset_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <string_view>

#include "platform/config/toml_text.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

using std::filesystem::path;

std::string description_of(toml::node_type type) {
  switch (type) {
    case toml::node_type::array:
      return "an array";
    case toml::node_type::date:
    case toml::node_type::time:
    case toml::node_type::date_time:
      return "a date or time";
    default:
      return "a table";
  }
}

/// Collects the values of one document; `name` stands before the line number in every origin.
class Reader {
 public:
  Reader(std::string name, RawConfig& values) : name_(std::move(name)), values_(values) {}

  std::string origin(const toml::node& node) const {
    return name_ + ":" + std::to_string(node.source().begin.line);
  }

  RawValue value(const toml::node& node, const std::string& key) const {
    RawValue raw;
    raw.origin = origin(node);
    if (const auto* table = node.as_table()) {
      annotated(*table, key, raw);
    } else {
      raw.value = plain(node);
    }
    return raw;
  }

  void section(const toml::table& table, const std::string& prefix) {
    for (const auto& [key, node] : table) {
      const std::string path = prefix + std::string(key.str());
      const auto* inner = node.as_table();
      if (inner && !inner->contains("value") && !inner->empty()) {
        section(*inner, path + ".");
      } else {
        values_[path] = value(node, path);
      }
    }
  }

 private:
  static std::variant<ConfigValue, NotAValue> plain(const toml::node& node) {
    if (const auto* boolean = node.as_boolean()) return ConfigValue(boolean->get());
    if (const auto* integer = node.as_integer()) return ConfigValue(std::int64_t{integer->get()});
    if (const auto* real = node.as_floating_point()) return ConfigValue(real->get());
    if (const auto* text = node.as_string()) return ConfigValue(text->get());
    return NotAValue{description_of(node.type()), false};
  }

  /// { value = 32, tag = "S", source = "paper, Stereo Matching" }
  void annotated(const toml::table& table, const std::string& key, RawValue& raw) const {
    raw.value = NotAValue{description_of(toml::node_type::table), table.empty()};
    for (const auto& [field, node] : table) {
      if (field == "value") {
        raw.value = plain(node);
        continue;
      }
      const auto* text = node.as_string();
      if (field == "source" && text) {
        raw.source = text->get();
      } else if (field == "tag" && text && tag_from_text(text->get())) {
        raw.tag = tag_from_text(text->get());
      } else if (field == "tag") {
        throw UserError(fmt::format(
            "{}: the tag of {} must be \"S\" (stated), \"D\" (derived), \"I\" (inferred), \"F\" (fitted) or "
            "\"C\" (own choice)",
            origin(node), excerpt(key)));
      } else if (field == "source") {
        throw UserError(fmt::format("{}: the source of {} must be text", origin(node), excerpt(key)));
      } else {
        throw UserError(fmt::format("{}: {} has an unknown part '{}'; it may have value, tag and source",
                                    origin(node), excerpt(key), excerpt(field.str())));
      }
    }
  }

  std::string name_;
  RawConfig& values_;
};

/// Takes a text entry of the document's head out of it, with its origin.
std::optional<std::pair<std::string, std::string>> take_text(toml::table& table, std::string_view key,
                                                             const Reader& reader) {
  const toml::node* node = table.get(key);
  if (!node) return std::nullopt;
  const std::string origin = reader.origin(*node);
  const auto* text = node->as_string();
  if (!text) throw UserError(fmt::format("{}: {} must be text", origin, key));
  std::pair<std::string, std::string> result{text->get(), origin};
  table.erase(key);
  return result;
}

}  // namespace

PresetFile read_preset_file(const path& file, const std::string& what) {
  PresetFile preset;
  preset.path = file;
  toml::table table = read_toml(file, what);
  Reader reader(file.string(), preset.values);
  if (const auto description = take_text(table, "description", reader))
    preset.description = description->first;
  if (const auto inherits = take_text(table, "inherits", reader)) {
    preset.inherits = inherits->first;
    preset.inherits_origin = inherits->second;
  }
  reader.section(table, "");
  return preset;
}

namespace {

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
}

}  // namespace

std::pair<std::string, RawValue> read_assignment(const std::string& argument) {
  const std::string origin = "--set " + excerpt(argument);
  const auto equals = argument.find('=');
  if (equals == std::string::npos || equals == 0) throw UserError(origin + ": must have the form key=value");
  if (equals + 1 == argument.size()) throw UserError(origin + ": the value is empty");
  const std::string key = trimmed(argument.substr(0, equals));
  const std::string text = trimmed(argument.substr(equals + 1));
  RawConfig ignored;
  RawValue raw;
  try {
    check_toml_depth(text, origin);
    const toml::table table = toml::parse("value = " + text);
    raw = Reader(origin, ignored).value(*table.get("value"), key);
    if (table.size() != 1) raw.value = ConfigValue(text);
  } catch (const toml::parse_error&) {
    raw.value = ConfigValue(text);  // a name without quotes
  }
  raw.origin = origin;
  if (!raw.source) raw.source = "command line";
  return {key, raw};
}

}  // namespace parallax
