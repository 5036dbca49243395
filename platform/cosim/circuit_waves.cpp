// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/circuit_waves.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace parallax {
namespace {

constexpr std::size_t kNumberBits = 64;

// Highest bit first; `is_set` says of each whether it is 1.
template <class IsSet>
std::string binary_digits(std::size_t width, const IsSet& is_set) {
  std::string digits(width, '0');
  for (std::size_t bit = 0; bit < width; ++bit) {
    if (is_set(bit)) digits[width - 1 - bit] = '1';
  }
  return digits;
}

std::string number_digits(std::uint64_t number) {
  return binary_digits(kNumberBits, [number](std::size_t bit) { return (number >> bit & 1u) != 0; });
}

std::string token_digits(const TokenWords& words, std::uint64_t token) {
  if (token >= words.size()) return "x";
  return binary_digits(words.width(), [&](std::size_t bit) { return words.bit(token, bit); });
}

}  // namespace

CircuitWaves::CircuitWaves(const Circuit& circuit, const CircuitPins& pins, const Outputs& outputs,
                           std::uint64_t cycles)
    : circuit_(circuit),
      pins_(pins),
      outputs_(outputs),
      cycles_(cycles),
      begins_{0},
      kept_(2 * cycles + 1),
      tokens_(kept_.size() * outputs.size()),
      written_(outputs.size()) {
  for (const parallax_pin& pin : circuit.pins()) begins_.push_back(begins_.back() + pin_bytes(pin));
  bytes_.resize(kept_.size() * begins_.back());
}

void CircuitWaves::take(Cycles cycle, bool edge, bool moved) {
  if (moved) moved_ = cycle;
  const bool edge_before = std::exchange(edge_, edge);
  if (complete() || ((cycle - moved_).size() > cycles_ && !outputs_changed())) return;
  if (left_ > 0) --left_;
  ++taken_;
  const std::size_t at = slot(0);
  kept_[at] = {cycle, edge_before, edge};
  char* const bytes = bytes_.data() + at * begins_.back();
  const std::vector<parallax_pin>& pins = circuit_.pins();
  for (std::size_t pin = 0; pin < pins.size(); ++pin)
    std::memcpy(bytes + begins_[pin], pins[pin].at, pin_bytes(pins[pin]));
  for (std::size_t output = 0; output < outputs_.size(); ++output) {
    const std::uint64_t before = std::exchange(written_[output], outputs_[output]->tokens());
    tokens_[at * outputs_.size() + output] = {before, written_[output] != before};
  }
}

bool CircuitWaves::outputs_changed() const {
  const char* const bytes = bytes_.data() + slot(0) * begins_.back();
  const std::vector<parallax_pin>& pins = circuit_.pins();
  for (std::size_t pin = 0; pin < pins.size(); ++pin) {
    if (pins[pin].is_input == 0 && std::memcmp(bytes + begins_[pin], pins[pin].at, pin_bytes(pins[pin])) != 0)
      return true;
  }
  return false;
}

void CircuitWaves::happened(const std::string& what, Cycles cycle) {
  if (any()) return;
  title_ = what;
  at_ = cycle;
  left_ = cycles_;
}

std::string CircuitWaves::pin_value(std::size_t slot, std::size_t pin) const {
  const char* const bytes = bytes_.data() + slot * begins_.back() + begins_[pin];
  return binary_digits(circuit_.pins()[pin].width, [bytes](std::size_t bit) {
    return (static_cast<unsigned char>(bytes[bit / 8]) >> bit % 8 & 1u) != 0;
  });
}

PinWaves CircuitWaves::waves(const ClockDomain& clock) const {
  PinWaves waves;
  waves.title = title_;
  waves.at = clock.date_of(at_);
  std::vector<std::size_t> shown;  // the clock has an edge of its own
  for (std::size_t pin = 0; pin < circuit_.pins().size(); ++pin) {
    const parallax_pin& each = circuit_.pins()[pin];
    if (&each == pins_.clock) {
      waves.clock = {circuit_.name(), each.name, 1};
      continue;
    }
    shown.push_back(pin);
    waves.signals.push_back({circuit_.name(), each.name, each.width});
  }
  for (const auto& output : outputs_) {
    const VectorStream& stream = output->port().stream;
    waves.signals.push_back({"model", stream.port + "_token", kNumberBits});
    waves.signals.push_back({"model", stream.port + "_expected", stream.shape.format.width().size()});
    waves.signals.push_back({"model", stream.port + "_differs", 1});
  }
  for (std::size_t age = std::min(taken_, kept_.size()); age-- > 0;) {
    const std::size_t at = slot(age);
    const Kept& kept = kept_[at];
    PinWaves::Cycle cycle{clock.date_of(kept.cycle), clock.date_of(kept.cycle + Cycles(1)), kept.edge_before,
                          kept.edge_after};
    for (const std::size_t pin : shown) cycle.values.push_back(pin_value(at, pin));
    for (std::size_t output = 0; output < outputs_.size(); ++output) {
      const Token& token = tokens_[at * outputs_.size() + output];
      const TokenWords& expected = outputs_[output]->port().model.words;
      const TokenWords& got = outputs_[output]->dump().words;
      const bool differs =
          token.passed && token.number < got.size() &&
          (token.number >= expected.size() || !got.same(token.number, expected, token.number));
      cycle.values.push_back(number_digits(token.number));
      cycle.values.push_back(token_digits(expected, token.number));
      cycle.values.push_back(differs ? "1" : "0");
    }
    waves.cycles.push_back(std::move(cycle));
  }
  return waves;
}

}  // namespace parallax
