// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "modules/token_formats.hpp"
#include "platform/machine/circuit_end.hpp"
#include "platform/machine/token_shape.hpp"
#include "tlm/stream.hpp"
#include "tlm/tap.hpp"

namespace parallax {

/// A token as a circuit has it on its wires.
struct WiredToken {
  std::uint64_t number = 0;                ///< at its port, from 0
  const std::vector<std::uint64_t>& bits;  ///< TokenFormat::width() of them, bit 0 lowest in the first word
  Cycles date;  ///< of the edge that reads it (input) or writes it (output), in the core's clock
};

/// Hands over the tokens of a port until it is destroyed, which must be after the simulation. Those of frames
/// without images, which come after all others, have no values and are not handed over.
class TokenTap {
 public:
  using Take = std::function<void(const WiredToken& token)>;
  virtual ~TokenTap() = default;
};

/// A port of what stands in a slot of the pipeline, with the tokens that pass it.
struct TokenPort {
  std::string name;  ///< "in_left"
  bool is_input = false;
  std::vector<std::string> streams;  ///< bound there; several have the same tokens (a fork)
  TokenShape shape;
  /// To be called before the simulation starts.
  std::function<std::unique_ptr<TokenTap>(const TokenTap::Take& take)> tap;
  /// The other end of its (first) stream, in place of who takes the values there: with is_input() where the
  /// port is an output. Empty: inside a stage, where nobody else can stand.
  std::function<std::unique_ptr<CircuitEnd>()> opposite;
};

/// Tokens of values of type T, one field after the other onto the wires.
template <class T>
class ValueTap final : public TokenTap {
 public:
  /// `reads`: with the dates of the reader's side.
  ValueTap(Stream<T>& stream, const TokenShape& shape, bool reads, Take take)
      : format_(shape.format),
        take_(std::move(take)),
        tap_(stream, config(shape, reads), [this](const TappedToken<T>& token) { hand_over(token); }) {}

 private:
  static TapConfig config(const TokenShape& shape, bool reads) {
    TapConfig config;
    config.values_per_token = shape.format.all().size() / kWiredFields<T>;
    config.runs = shape.runs;
    config.dates_wait =
        true;  // records come back from memory a row at a time, behind the first of their dates
    config.side = reads ? TapConfig::Side::kReads : TapConfig::Side::kWrites;
    return config;
  }
  void hand_over(const TappedToken<T>& token) {
    pack_values(format_, token.values, token.size, bits_);
    take_({token.number, bits_, token.date});
  }

  const TokenFormat format_;
  const Take take_;
  std::vector<std::uint64_t> bits_;
  Tap<T> tap_;
};

}  // namespace parallax
