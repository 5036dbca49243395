// SPDX-License-Identifier: Apache-2.0
// The raw layer of the configuration: values as a file or the command line gives them, not yet checked.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>

namespace parallax {

/// How certain a number is; one letter in a preset.
enum class Tag : char {
  kStated = 'S',    ///< the source says it
  kDerived = 'D',   ///< arithmetic on stated numbers
  kInferred = 'I',  ///< inference from evidence, may be wrong
  kFitted = 'F',    ///< chosen so that the model meets published figures
  kChoice = 'C',    ///< our own or the user's choice
};

std::optional<Tag> tag_from_text(const std::string& text);

/// Where a number comes from.
struct Provenance {
  Tag tag = Tag::kChoice;
  std::string source;
};

inline Provenance stated(std::string source) { return {Tag::kStated, std::move(source)}; }
inline Provenance derived(std::string source) { return {Tag::kDerived, std::move(source)}; }
inline Provenance inferred(std::string source) { return {Tag::kInferred, std::move(source)}; }
inline Provenance fitted(std::string source) { return {Tag::kFitted, std::move(source)}; }
inline Provenance chosen(std::string source) { return {Tag::kChoice, std::move(source)}; }

/// A value that a key can hold; a choice is held by its name.
using ConfigValue = std::variant<bool, std::int64_t, double, std::string>;

/// The value as TOML writes it; reading it back gives the same value.
std::string to_toml(const ConfigValue& value);

/// Something that no key can hold, kept so that the message can name it.
struct NotAValue {
  std::string description;     ///< "an array", "a date", ...
  bool empty_section = false;  ///< a section heading with nothing below it: harmless when the section exists
};

/// One entry of a preset, or one `--set`.
struct RawValue {
  std::variant<ConfigValue, NotAValue> value;
  std::optional<Tag> tag;
  std::optional<std::string> source;
  std::string origin;  ///< "file:line" or the command-line argument, for messages
  int layer =
      0;  ///< 0: the preset that inherits nothing; one more for each that inherits; --set is above all
};

/// Key path ("matching.p1") to what was given for it.
using RawConfig = std::map<std::string, RawValue>;

}  // namespace parallax
