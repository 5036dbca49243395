// SPDX-License-Identifier: Apache-2.0
#include "platform/validation/published_row.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "platform/config/nearest_name.hpp"
#include "platform/config/preset.hpp"
#include "platform/config/toml_text.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

// A preset that is a path is one from the rows' folder. `origin`: of the entry, for the message.
std::string preset_beside(const std::filesystem::path& rows, const std::string& preset,
                          const std::string& origin) {
  if (!is_preset_path(preset)) return preset;
  const std::filesystem::path file =
      rows.has_parent_path() ? rows.parent_path() / preset : std::filesystem::path(preset);
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) {
    throw UserError(fmt::format("{}: preset file {} does not exist", origin, file.string()));
  }
  return file.string();
}

// One [[row]].
class RowReader {
 public:
  RowReader(std::string file, const toml::table& table) : file_(std::move(file)), table_(table) {
    const std::vector<std::string> known{"name",    "source", "preset", "set",       "size",  "rectified",
                                         "refused", "metric", "unit",   "published", "least", "most"};
    for (const auto& [key, node] : table) {
      const std::string word(key.str());
      if (std::find(known.begin(), known.end(), word) == known.end()) {
        throw UserError(fmt::format("{}: a row has no '{}'; the nearest is {}", origin(node), excerpt(word),
                                    nearest_name(word, known)));
      }
    }
  }

  PublishedRow read() const {
    PublishedRow row;
    row.origin = origin(table_);
    row.name = required<std::string>("name", "text");
    row.source = required<std::string>("source", "text, where it was published");
    if (const auto preset = optional<std::string>("preset", "text")) {
      row.preset = preset_beside(file_, *preset, origin(*table_.get("preset")));
    }
    const std::string size = required<std::string>("size", "a size such as \"640x480\"");
    char rest = 0;
    if (std::sscanf(size.c_str(), "%5dx%5d%c", &row.width, &row.height, &rest) != 2 || row.width < 1 ||
        row.height < 1) {
      fail("size", "a size such as \"640x480\"");
    }
    row.rectified = optional<bool>("rectified", "true or false").value_or(false);
    row.refused = optional<bool>("refused", "true or false").value_or(false);
    read_assignments(row);
    if (row.refused) return row;
    row.metric = required<std::string>("metric", "text, a number of timing.json or frame_time");
    row.unit = required<std::string>("unit", "text");
    row.published = number("published", "a number above 0");
    if (!(row.published > 0)) fail("published", "a number above 0");
    row.least = number("least", "a number of percent");
    row.most = number("most", "a number of percent");
    if (row.most < row.least) fail("most", fmt::format("at least {}, as `least` is", row.least));
    return row;
  }

 private:
  std::string origin(const toml::node& node) const {
    return fmt::format("{}:{}", file_, node.source().begin.line);
  }
  [[noreturn]] void fail(const char* key, const std::string& expected) const {
    const toml::node* const node = table_.get(key);
    throw UserError(
        fmt::format("{}: {} must be {}", origin(node == nullptr ? table_ : *node), key, expected));
  }
  template <class T>
  std::optional<T> optional(const char* key, const char* expected) const {
    const toml::node* const node = table_.get(key);
    if (node == nullptr) return std::nullopt;
    std::optional<T> value = node->value<T>();
    if (!value) fail(key, expected);
    return value;
  }
  template <class T>
  T required(const char* key, const char* expected) const {
    const std::optional<T> value = optional<T>(key, expected);
    if (!value) fail(key, expected);
    return *value;
  }
  double number(const char* key, const char* expected) const {
    const auto value = required<double>(key, expected);
    // Figures of machines lie far within: what does not would leave the range of a number when it is divided
    // by.
    constexpr double kMost = 1e30;
    if (!std::isfinite(value) || std::abs(value) > kMost || (value != 0 && std::abs(value) < 1 / kMost))
      fail(key, expected);
    return value;
  }
  void read_assignments(PublishedRow& row) const {
    const toml::node* const node = table_.get("set");
    if (node == nullptr) return;
    constexpr const char* kExpected = "a list of texts such as \"matching.iterations=8\"";
    if (!node->is_array()) fail("set", kExpected);
    for (const toml::node& element : *node->as_array()) {
      const std::optional<std::string> text = element.value<std::string>();
      if (!text) fail("set", kExpected);
      row.assignments.push_back(*text);
    }
  }

  const std::string file_;
  const toml::table& table_;
};

}  // namespace

std::vector<std::string> published_row_files() { return {"scenescan-pro", "other-designs"}; }

PublishedRows read_published_rows(const std::string& name,
                                  const std::vector<std::filesystem::path>& preset_folders) {
  std::vector<std::filesystem::path> folders;
  for (const std::filesystem::path& folder : preset_folders) folders.push_back(folder / "validation");
  const std::filesystem::path file = find_toml(name, folders, "rows");
  const toml::table table = read_toml(file, "rows");
  PublishedRows result;
  result.description = table["description"].value_or(std::string());
  result.preset = table["preset"].value_or(std::string("scenescan-pro"));
  if (const toml::node* preset = table.get("preset")) {
    result.preset =
        preset_beside(file, result.preset, fmt::format("{}:{}", file.string(), preset->source().begin.line));
  }
  for (const auto& [key, node] : table) {
    if (key == "description" || key == "preset") continue;
    if (key != "row" || !node.is_array_of_tables()) {
      throw UserError(fmt::format("{}:{}: unknown entry '{}'; there may be description, preset and [[row]]",
                                  file.string(), node.source().begin.line, excerpt(key.str())));
    }
    for (const toml::node& row : *node.as_array()) {
      result.rows.push_back(RowReader(file.string(), *row.as_table()).read());
    }
  }
  if (result.rows.empty()) throw UserError(fmt::format("{}: holds no [[row]]", file.string()));
  return result;
}

}  // namespace parallax
