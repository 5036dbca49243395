// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "platform/cosim/vector_manifest.hpp"

namespace parallax {

/// "1 cycle", "12,345 cycles"
std::string cycles_text(std::int64_t cycles);

/// The dates of a stream of vectors. Throws UserError when there are not as many as tokens.
std::vector<std::int64_t> read_dates(const std::string& path, const VectorStream& stream);

/// When a circuit's tokens left it beside when the model's did, in cycles.
class TokenDates {
 public:
  /// Of an output stream; the first of what both have are compared.
  TokenDates(const VectorStream& stream, const std::vector<std::int64_t>& got,
             const std::vector<std::int64_t>& expected);

  /// Whether no token is more than so many cycles later than the model's.
  bool within(const std::optional<std::int64_t>& bound) const {
    return !bound || !known_ || latest_ <= *bound;
  }
  /// Lines; none if there is no token.
  std::string text(const std::optional<std::int64_t>& bound) const;
  /// Adds what is known to the tree of a stream.
  void add_to(nlohmann::ordered_json& tree) const;

 private:
  struct Pair {
    std::int64_t circuit, model;
  };
  static nlohmann::ordered_json column(const std::vector<Pair>& pairs, std::int64_t Pair::*of);
  std::string rows_text() const;

  std::vector<Pair> frames_;  // from the first to the last token of each
  std::vector<Pair> rows_;    // of each row of the first one (and tile), likewise
  std::int64_t latest_ = 0;   // most that a token is behind the model's
  std::uint64_t latest_token_ = 0;
  bool known_ = false;  // of a token at least
};

}  // namespace parallax
