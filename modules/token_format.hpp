// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "modules/bit_vector.hpp"
#include "tlm/units.hpp"

namespace parallax {

/// One field of a token: which wires carry it.
struct TokenField {
  std::string name;
  std::size_t low = 0;     ///< bit of the bus that carries the field's bit 0
  std::size_t width = 0;   ///< bits, 1 to 64
  bool is_signed = false;  ///< two's complement
};

/// How a token lies on the wires of a stream: its fields, one after the other from bit 0 on, without gaps. It
/// is the width of the stream's FIFO, what moving a token is estimated by, and the bus of a circuit there.
class TokenFormat {
 public:
  /// Appends a field above those there.
  TokenFormat& field(const std::string& name, std::size_t width, bool is_signed = false);
  /// Appends `number` fields name_0, name_1, ... of the same width.
  TokenFormat& fields(const std::string& name, std::size_t number, std::size_t width);

  /// So many of these side by side: the fields of number i are called name_i; one is as it is.
  TokenFormat several(std::size_t number) const;

  const std::vector<TokenField>& all() const { return fields_; }
  /// Bits of a token.
  Bits width() const { return Bits(bits_); }

  BitVector bus() const { return BitVector(bits_); }
  /// Value of field `index` on `bus`; a signed one with its sign.
  std::int64_t get(const BitVector& bus, std::size_t index) const;
  /// std::out_of_range when the field is too narrow for the value.
  void set(BitVector& bus, std::size_t index, std::int64_t value) const;

 private:
  std::vector<TokenField> fields_;
  std::size_t bits_ = 0;
};

/// Puts the fields of a token one after the other into words of 64 bits.
class FieldPacker {
 public:
  /// `bits` becomes as long as the format's width needs, all 0; both must outlive the packer.
  FieldPacker(const TokenFormat& format, std::vector<std::uint64_t>& bits) : format_(format), bits_(bits) {
    bits_.assign((format.width().size() + kWord - 1) / kWord, 0);
  }

  /// std::out_of_range when the field is too narrow for the value, or there is no further field.
  void next(std::int64_t value);

 private:
  static constexpr std::size_t kWord = 64;

  const TokenFormat& format_;
  std::vector<std::uint64_t>& bits_;
  std::size_t field_ = 0;
};

/// Takes the fields of a token one after the other out of words of 64 bits.
class FieldUnpacker {
 public:
  /// Of as many bits as the format's width; both must outlive it.
  FieldUnpacker(const TokenFormat& format, const std::vector<std::uint64_t>& bits)
      : format_(format), bits_(bits) {}

  /// With its sign. std::out_of_range when there is no further field.
  std::int64_t next();

 private:
  const TokenFormat& format_;
  const std::vector<std::uint64_t>& bits_;
  std::size_t field_ = 0;
};

}  // namespace parallax
