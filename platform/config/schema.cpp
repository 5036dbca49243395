// SPDX-License-Identifier: Apache-2.0
#include "platform/config/schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "platform/config/nearest_key.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

/// An exact whole number written as a real ("150e6") is welcome where an integer is wanted, and the reverse.
std::optional<std::int64_t> as_integer(const ConfigValue& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return *integer;
  const auto* real = std::get_if<double>(&value);
  constexpr double kExactLimit = 9007199254740992.0;  // 2^53: beyond it a double skips integers
  if (real && std::abs(*real) <= kExactLimit && std::trunc(*real) == *real) {
    return static_cast<std::int64_t>(*real);
  }
  return std::nullopt;
}

std::optional<double> as_real(const ConfigValue& value) {
  if (const auto* real = std::get_if<double>(&value)) return *real;
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
  return std::nullopt;
}

/// "w, nw" -> {"w", "nw"}
std::vector<std::string> split_names(const std::string& text) {
  std::vector<std::string> names(1);
  for (const char c : text) {
    if (c == ',') {
      names.emplace_back();
    } else if (c != ' ') {
      names.back() += c;
    }
  }
  return names;
}

/// The value in the type of the key, or nothing when it does not belong there.
std::optional<ConfigValue> fit(const Key& key, const ConfigValue& value) {
  switch (key.type) {
    case KeyType::kBoolean:
      if (std::holds_alternative<bool>(value)) return value;
      break;
    case KeyType::kInteger:
      if (const auto integer = as_integer(value)) {
        if (*integer >= key.integers.least && *integer <= key.integers.most) return ConfigValue(*integer);
      }
      break;
    case KeyType::kReal:
      if (const auto real = as_real(value)) {
        if (*real >= key.reals.least && *real <= key.reals.most) return ConfigValue(*real);
      }
      break;
    case KeyType::kChoice:
      if (const auto* name = std::get_if<std::string>(&value)) {
        if (std::find(key.names.begin(), key.names.end(), *name) != key.names.end()) return value;
      }
      break;
    case KeyType::kNameSet:
      if (const auto* text = std::get_if<std::string>(&value)) {
        const std::vector<std::string> wanted = split_names(*text);
        const auto known = [&](const std::string& name) {
          return std::find(key.names.begin(), key.names.end(), name) != key.names.end();
        };
        if (std::all_of(wanted.begin(), wanted.end(), known)) return value;
      }
      break;
    case KeyType::kText:
      if (const auto* text = std::get_if<std::string>(&value)) {
        if (!text->empty()) return value;
      }
      break;
  }
  return std::nullopt;
}

}  // namespace

std::string Key::section() const { return path.substr(0, path.find('.')); }
std::string Key::name() const { return path.substr(path.find('.') + 1); }

std::string Key::expected() const {
  switch (type) {
    case KeyType::kBoolean:
      return "true or false";
    case KeyType::kInteger:
      return fmt::format("an integer from {} to {}", integers.least, integers.most);
    case KeyType::kReal:
      return fmt::format("a number from {} to {}", reals.least, reals.most);
    case KeyType::kChoice:
      return fmt::format("one of {}", fmt::join(names, ", "));
    case KeyType::kNameSet:
      return fmt::format("one or more of {}, separated by commas", fmt::join(names, ", "));
    case KeyType::kText:
      return "a text";
  }
  return {};
}

void Schema::real(std::string path, double& field, RealRange range, std::string unit,
                  std::string documentation, Provenance provenance) {
  Key key{std::move(path), KeyType::kReal, std::move(unit), std::move(documentation), std::move(provenance)};
  key.reals = range;
  key.get = [&field] { return ConfigValue(field); };
  key.set = [&field](const ConfigValue& value) { field = std::get<double>(value); };
  add(std::move(key));
}

void Schema::text(std::string path, std::string& field, std::string documentation, Provenance provenance) {
  Key key{std::move(path), KeyType::kText, "", std::move(documentation), std::move(provenance)};
  key.get = [&field] { return ConfigValue(field); };
  key.set = [&field](const ConfigValue& value) { field = std::get<std::string>(value); };
  add(std::move(key));
}

void Schema::boolean(std::string path, bool& field, std::string documentation, Provenance provenance) {
  Key key{std::move(path), KeyType::kBoolean, "", std::move(documentation), std::move(provenance)};
  key.get = [&field] { return ConfigValue(field); };
  key.set = [&field](const ConfigValue& value) { field = std::get<bool>(value); };
  add(std::move(key));
}

void Schema::name_set(std::string path, unsigned& field,
                      const std::vector<std::pair<std::string, unsigned>>& bits, std::string documentation,
                      Provenance provenance) {
  Key key{std::move(path), KeyType::kNameSet, "", std::move(documentation), std::move(provenance)};
  for (const auto& [name, bit] : bits) key.names.push_back(name);
  key.get = [&field, bits] {
    std::string text;
    for (const auto& [name, bit] : bits) {
      if (field & bit) text += (text.empty() ? "" : ", ") + name;
    }
    return ConfigValue(text);
  };
  key.set = [&field, bits](const ConfigValue& value) {
    field = 0;
    for (const std::string& wanted : split_names(std::get<std::string>(value))) {
      for (const auto& [name, bit] : bits) field |= name == wanted ? bit : 0U;
    }
  };
  add(std::move(key));
}

void Schema::add(Key key) {
  if (find(key.path)) throw std::logic_error("the key " + key.path + " is declared twice");
  keys_.push_back(std::move(key));
}

const Key* Schema::find(const std::string& path) const {
  const auto key = std::find_if(keys_.begin(), keys_.end(), [&](const Key& k) { return k.path == path; });
  return key == keys_.end() ? nullptr : &*key;
}

void Schema::apply(const RawConfig& raw) {
  for (const auto& [path, value] : raw) apply(path, value);
}

void Schema::apply(const std::string& path, const RawValue& raw) {
  const auto key = std::find_if(keys_.begin(), keys_.end(), [&](const Key& k) { return k.path == path; });
  const auto* not_a_value = std::get_if<NotAValue>(&raw.value);
  if (key == keys_.end()) {
    const bool is_section = std::any_of(keys_.begin(), keys_.end(),
                                        [&](const Key& k) { return k.path.rfind(path + ".", 0) == 0; });
    if (is_section && not_a_value && not_a_value->empty_section) return;
    if (is_section) throw UserError(fmt::format("{}: {} is a section, not a key", raw.origin, excerpt(path)));
    std::vector<std::string> paths;
    for (const Key& k : keys_) paths.push_back(k.path);
    throw UserError(fmt::format("{}: unknown key {}; the nearest is {}", raw.origin, excerpt(path),
                                nearest_key(path, paths)));
  }
  if (not_a_value) {
    throw UserError(
        fmt::format("{}: {} is {}: must be {}", raw.origin, path, not_a_value->description, key->expected()));
  }
  const ConfigValue& value = std::get<ConfigValue>(raw.value);
  const auto fitting = fit(*key, value);
  if (!fitting) {
    throw UserError(
        fmt::format("{}: {} = {}: must be {}", raw.origin, path, excerpt(to_toml(value)), key->expected()));
  }
  key->set(*fitting);
  key->provenance = {raw.tag.value_or(Tag::kChoice), raw.source.value_or(raw.origin)};
}

void Schema::check() const {
  for (const Key& key : keys_) {
    if (!fit(key, key.get())) {
      throw UserError(
          fmt::format("{} = {}: must be {}", key.path, excerpt(to_toml(key.get())), key.expected()));
    }
  }
}

}  // namespace parallax
