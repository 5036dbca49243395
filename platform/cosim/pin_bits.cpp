// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/pin_bits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace parallax {
namespace {

constexpr std::size_t kPinWord = 64;
constexpr std::size_t kByte = 8;

unsigned char* bytes_at(const parallax_pin& pin) { return static_cast<unsigned char*>(pin.at); }

}  // namespace

// The simulator keeps an integer, or words of 32 bits.
std::size_t pin_bytes(const parallax_pin& pin) {
  for (const unsigned bits : {8u, 16u, 32u, 64u}) {
    if (pin.width <= bits) return bits / kByte;
  }
  return (pin.width + 31) / 32 * 4;
}

PinBits::PinBits(const parallax_pin& pin, std::size_t low, std::size_t width)
    : pin_(&pin), low_(low), width_(width) {
  if (low == 0 && width == pin.width && width <= kPinWord) bytes_ = pin_bytes(pin);
  mask_ = width < kPinWord ? (std::uint64_t{1} << width) - 1 : ~std::uint64_t{0};
}

std::string PinBits::name() const {
  if (low_ == 0 && width_ == pin_->width) return pin_->name;
  return width_ == 1 ? fmt::format("{}[{}]", pin_->name, low_)
                     : fmt::format("{}[{}:{}]", pin_->name, low_ + width_ - 1, low_);
}

void PinBits::put(std::size_t at, std::size_t bits, std::uint64_t value) const {
  for (std::size_t done = 0; done < bits;) {
    const std::size_t bit = (low_ + at + done) % kByte;
    const std::size_t count = std::min(kByte - bit, bits - done);
    const unsigned mask = ((1u << count) - 1) << bit;
    unsigned char& byte = bytes_at(*pin_)[(low_ + at + done) / kByte];
    byte = static_cast<unsigned char>((byte & ~mask) | (static_cast<unsigned>(value >> done) << bit & mask));
    done += count;
  }
}

std::uint64_t PinBits::get(std::size_t at, std::size_t bits) const {
  std::uint64_t value = 0;
  for (std::size_t done = 0; done < bits;) {
    const std::size_t bit = (low_ + at + done) % kByte;
    const std::size_t count = std::min(kByte - bit, bits - done);
    const unsigned part = static_cast<unsigned>(bytes_at(*pin_)[(low_ + at + done) / kByte]) >> bit;
    value |= std::uint64_t{part & ((1u << count) - 1)} << done;
    done += count;
  }
  return value;
}

void PinBits::set(std::uint64_t value) const {
  value &= mask_;
  switch (bytes_) {
    case 1:
      *bytes_at(*pin_) = static_cast<unsigned char>(value);
      break;
    case 0:
      for (std::size_t at = 0; at < width_; at += kPinWord, value = 0)
        put(at, std::min(kPinWord, width_ - at), value);
      break;
    default:
      std::memcpy(pin_->at, &value, bytes_);
  }
}

void PinBits::set(const std::vector<std::uint64_t>& words) const {
  if (whole_word()) return set(words.empty() ? 0 : words[0]);
  for (std::size_t at = 0; at < width_; at += kPinWord) {
    const std::size_t word = at / kPinWord;
    const std::size_t bits = std::min(kPinWord, width_ - at);
    const std::uint64_t value = word < words.size() ? words[word] : 0;
    if (low_ == 0 && bits == kPinWord) {
      std::memcpy(bytes_at(*pin_) + at / kByte, &value, sizeof value);
    } else {
      put(at, bits, value);
    }
  }
}

bool PinBits::any() const {
  if (bytes_ == 1) return *bytes_at(*pin_) != 0;
  for (std::size_t at = 0; at < width_; at += kPinWord) {
    if (get(at, std::min(kPinWord, width_ - at)) != 0) return true;
  }
  return false;
}

void PinBits::read(std::vector<std::uint64_t>& words) const {
  words.assign((width_ + kPinWord - 1) / kPinWord, 0);
  if (low_ == 0 && width_ == pin_->width) {
    std::memcpy(words.data(), pin_->at, std::min(words.size() * sizeof words[0], pin_bytes(*pin_)));
    return;
  }
  for (std::size_t at = 0; at < width_; at += kPinWord)
    words[at / kPinWord] = get(at, std::min(kPinWord, width_ - at));
}

}  // namespace parallax
