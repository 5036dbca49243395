// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/toml_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "platform/config/config_value.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

// What a table says that is no section of keys.
constexpr std::array<const char*, 4> kOfALeaf{"from", "value", "at_least", "at_most"};

void add_leaves(const TomlPart& part, const std::string& before, std::vector<TomlPart>& leaves) {
  for (TomlPart& entry : part.entries()) {
    entry.name = before + entry.name;
    const toml::table* const inner = entry.node->as_table();
    const bool holds_more =
        inner != nullptr && !inner->empty() &&
        std::none_of(kOfALeaf.begin(), kOfALeaf.end(), [&](const char* key) { return inner->contains(key); });
    if (holds_more) {
      add_leaves(entry, entry.name + ".", leaves);
    } else {
      entry.section = part.section;
      leaves.push_back(std::move(entry));
    }
  }
}

// "150e6" rather than 150000000.0, which is the same to whoever reads it back.
std::string short_number(double value) {
  if (!(std::abs(value) >= 1e4 && std::abs(value) < 1e15) || std::floor(value) != value)
    return to_toml(ConfigValue(value));
  std::string digits = fmt::format("{:.0f}", value);
  int zeros = 0;
  for (; digits.size() > 3 && digits.compare(digits.size() - 3, 3, "000") == 0; zeros += 3)
    digits.resize(digits.size() - 3);
  return zeros == 0 ? digits + ".0" : fmt::format("{}e{}", digits, zeros);
}

}  // namespace

std::string toml_origin(const std::string& file, const toml::node& node) {
  return fmt::format("{}:{}", file, node.source().begin.line);
}

void TomlPart::fail(const std::string& why) const {
  throw UserError(fmt::format("{}: {}: {}", origin(), excerpt(name), why));
}

// In the order of the file, which a table of the library does not keep.
std::vector<TomlPart> TomlPart::entries() const {
  const toml::table* const table = node->as_table();
  if (table == nullptr) fail("must be a table");
  std::vector<TomlPart> all;
  for (const auto& [key, entry] : *table) all.push_back({file, std::string(key.str()), &entry, name});
  const auto place = [](const TomlPart& part) {
    const toml::source_position& begin = part.node->source().begin;
    return std::tuple(begin.line, begin.column);
  };
  std::stable_sort(all.begin(), all.end(),
                   [&](const TomlPart& a, const TomlPart& b) { return place(a) < place(b); });
  return all;
}

std::vector<TomlPart> TomlPart::leaves() const {
  std::vector<TomlPart> all;
  TomlPart root = *this;
  root.section = name;
  add_leaves(root, "", all);
  for (TomlPart& leaf : all) leaf.section = name;
  return all;
}

std::vector<TomlPart> TomlPart::elements() const {
  const toml::array* const array = node->as_array();
  if (array == nullptr) fail("must be an array");
  std::vector<TomlPart> all;
  for (const toml::node& element : *array) all.push_back({file, name, &element, section});
  return all;
}

std::string TomlPart::text() const {
  const toml::value<std::string>* const held = node->as_string();
  if (held == nullptr) fail("must be text, in quotes");
  return held->get();
}

double TomlPart::number() const {
  const std::optional<double> held = node->is_number() ? node->value<double>() : std::nullopt;
  if (!held || !std::isfinite(*held)) fail("must be a number");
  return *held;
}

std::int64_t TomlPart::whole(std::int64_t least, std::int64_t most) const {
  const toml::value<std::int64_t>* const held = node->as_integer();
  if (held == nullptr || held->get() < least || held->get() > most)
    fail(fmt::format("must be a whole number from {} to {}", least, most));
  return held->get();
}

std::string TomlPart::value() const {
  if (const auto* boolean = node->as_boolean()) return to_toml(ConfigValue(boolean->get()));
  if (const auto* integer = node->as_integer()) return to_toml(ConfigValue(std::int64_t{integer->get()}));
  if (const auto* real = node->as_floating_point()) return short_number(real->get());
  if (const auto* held = node->as_string()) return held->get();
  fail("must be a number, true, false or text");
}

std::vector<std::string> TomlPart::values() const {
  if (!node->is_array()) return {value()};
  std::vector<std::string> all;
  for (const TomlPart& element : elements()) all.push_back(element.value());
  return all;
}

}  // namespace parallax
