// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "platform/cosim/dump_file.hpp"
#include "platform/cosim/stage_effect.hpp"
#include "platform/cosim/token_words.hpp"
#include "platform/cosim/vector_manifest.hpp"

namespace parallax {

/// The first value in stream order that is not the model's.
struct FirstDifference {
  std::uint64_t token = 0;
  std::size_t field = 0;
  ValuePlace place;
  std::string expected, got;          ///< decimal; codes in hexadecimal; what is unknown as x
  std::optional<std::int64_t> cycle;  ///< of the dump, if it says
};

/// What all the differences have in common.
struct DifferencePattern {
  std::string name;                     ///< a word for programs: "only_first_row"
  std::string text;                     ///< a sentence for readers
  std::optional<std::int64_t> frame{};  ///< that it is of, where it is of one alone
};

/// A stream of a circuit beside the model's.
struct TokenComparison {
  const VectorManifest* manifest = nullptr;
  const VectorStream* stream = nullptr;
  std::uint64_t expected_tokens = 0, got_tokens = 0;
  std::uint64_t compared_tokens = 0;  ///< that both have
  std::uint64_t different_tokens = 0, unknown_tokens = 0;
  std::uint64_t different_values = 0;
  std::optional<FirstDifference> first;
  /// How many values differ in each row, column (of all frames) and disparity; only those where some do.
  std::map<std::int64_t, std::uint64_t> rows, columns, disparities;
  std::map<std::string, std::uint64_t> fields;
  std::vector<DifferencePattern> patterns;  ///< the most telling first; none when equal
  StageEffect effect;

  bool equal() const { return different_tokens == 0 && expected_tokens == got_tokens; }
};

/// `expected` and `got` have the width of the stream. What is passed by reference must outlive the result.
/// `model` has what other streams of the manifest are asked for; without it, what only these tell is not
/// told.
TokenComparison compare_tokens(const VectorManifest& manifest, const VectorStream& stream,
                               const TokenWords& expected, const Dump& got, const ModelTokens& model = {});

/// Calls `take` with each value that differs, in stream order.
void for_each_difference(const VectorStream& stream, const TokenWords& expected, const TokenWords& got,
                         const std::function<void(std::uint64_t token, std::size_t field)>& take);

/// Puts a pattern before what else was found, in the place of `none`.
void say_first(TokenComparison& comparison, const DifferencePattern& pattern);

std::string text(const TokenComparison& comparison);
nlohmann::ordered_json to_json(const TokenComparison& comparison);

}  // namespace parallax
