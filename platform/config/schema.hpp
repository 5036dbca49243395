// SPDX-License-Identifier: Apache-2.0
// The table of all configuration keys. One declaration a key: its path, the field that it is bound to, its
// range, unit, documentation and where its default comes from. Reading, checking, printing and documenting go
// through it.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "platform/config/config_value.hpp"

namespace parallax {

struct IntegerRange {
  std::int64_t least;
  std::int64_t most;
};

struct RealRange {
  double least;
  double most;
};

enum class KeyType {
  kBoolean,
  kInteger,
  kReal,
  kChoice,   ///< one of its names
  kNameSet,  ///< one or more of its names, "w, nw, n"
  kText,     ///< any text but none
};

/// One key, bound to a field of a configuration struct.
struct Key {
  std::string path;           ///< "matching.p1": section and name
  KeyType type;               ///< what kind of value it holds
  std::string unit;           ///< empty when it has none (booleans, choices)
  std::string documentation;  ///< one or two sentences
  Provenance provenance;      ///< of the value now in the field

  IntegerRange integers{0, 0};       ///< for kInteger
  RealRange reals{0.0, 0.0};         ///< for kReal
  std::vector<std::string> names{};  ///< for kChoice and kNameSet

  std::function<ConfigValue()> get{};
  std::function<void(const ConfigValue&)> set{};  ///< takes a value that was checked

  std::string section() const;   ///< "matching", "dma"
  std::string name() const;      ///< "p1", "left.burst_bytes"
  std::string expected() const;  ///< "an integer from 0 to 255"
};

/// Holds references to the fields: the configuration struct must outlive it and stay where it is.
class Schema {
 public:
  template <class Integer>
  void integer(std::string path, Integer& field, IntegerRange range, std::string unit,
               std::string documentation, Provenance provenance);
  void real(std::string path, double& field, RealRange range, std::string unit, std::string documentation,
            Provenance provenance);
  void text(std::string path, std::string& field, std::string documentation, Provenance provenance);
  void boolean(std::string path, bool& field, std::string documentation, Provenance provenance);
  template <class Enum>
  void choice(std::string path, Enum& field, std::vector<std::pair<std::string, Enum>> names,
              std::string documentation, Provenance provenance);

  /// A set of names, each a bit of the field.
  void name_set(std::string path, unsigned& field, const std::vector<std::pair<std::string, unsigned>>& bits,
                std::string documentation, Provenance provenance);

  const std::vector<Key>& keys() const { return keys_; }
  const Key* find(const std::string& path) const;

  /// Writes all values of the raw layer into the fields. Throws UserError, one line with the value's origin,
  /// at the first unknown key, wrong type or value out of range.
  void apply(const RawConfig& raw);

  /// Throws UserError when a field holds a value out of its range (a struct that was filled in by a program).
  void check() const;

 private:
  void add(Key key);
  void apply(const std::string& path, const RawValue& raw);

  std::vector<Key> keys_;
};

template <class Integer>
void Schema::integer(std::string path, Integer& field, IntegerRange range, std::string unit,
                     std::string documentation, Provenance provenance) {
  static_assert(std::is_integral_v<Integer> && !std::is_same_v<Integer, bool>, "an integer field");
  using Limits = std::numeric_limits<Integer>;
  const std::int64_t lowest = Limits::min();
  const bool least_fits = lowest <= range.least;
  const bool most_fits =
      range.most <= 0 || static_cast<std::uint64_t>(Limits::max()) >= static_cast<std::uint64_t>(range.most);
  if (!least_fits || !most_fits) throw std::logic_error("the range of " + path + " exceeds its field");

  Key key{std::move(path), KeyType::kInteger, std::move(unit), std::move(documentation),
          std::move(provenance)};
  key.integers = range;
  key.get = [&field] { return ConfigValue(static_cast<std::int64_t>(field)); };
  key.set = [&field](const ConfigValue& value) {
    field = static_cast<Integer>(std::get<std::int64_t>(value));
  };
  add(std::move(key));
}

template <class Enum>
void Schema::choice(std::string path, Enum& field, std::vector<std::pair<std::string, Enum>> names,
                    std::string documentation, Provenance provenance) {
  Key key{std::move(path), KeyType::kChoice, "", std::move(documentation), std::move(provenance)};
  for (const auto& [name, value] : names) key.names.push_back(name);
  key.get = [&field, names] {
    for (const auto& [name, value] : names) {
      if (value == field) return ConfigValue(name);
    }
    return ConfigValue(std::string("(unnamed)"));
  };
  key.set = [&field, names](const ConfigValue& wanted) {
    for (const auto& [name, value] : names) {
      if (name == std::get<std::string>(wanted)) field = value;
    }
  };
  add(std::move(key));
}

}  // namespace parallax
