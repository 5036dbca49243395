// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/pin_lookup.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "platform/cosim/nearest_or_all.hpp"
#include "platform/cosim/signal_bits.hpp"
#include "tlm/error.hpp"

namespace parallax {
const parallax_pin* PinLookup::pin(const std::string& name) const {
  for (const parallax_pin& each : circuit_.pins()) {
    if (name == each.name) return &each;
  }
  return nullptr;
}

PinLookup::Names PinLookup::names() const {
  Names names;
  for (const parallax_pin& each : circuit_.pins()) names.emplace_back(each.name);
  return names;
}

PinBits PinLookup::named(const std::string& word, const std::string& option) const {
  const auto bits = read_named_bits(word);
  if (!bits) throw UserError(fmt::format("{}: a pin is PIN, PIN[BIT] or PIN[HIGH:LOW]", option));
  const parallax_pin* const found = pin(bits->name);
  if (found == nullptr) {
    throw UserError(fmt::format("{}: circuit {} has no such pin; {}", option, circuit_.name(),
                                nearest_or_all(bits->name, names())));
  }
  if (!bits->range) return PinBits(*found);
  const auto [high, low] = *bits->range;
  if (high >= found->width) {
    throw UserError(fmt::format("{}: pin {} of circuit {} has the bits {} to 0", option, bits->name,
                                circuit_.name(), found->width - 1));
  }
  return PinBits(*found, low, high - low + 1);
}

const parallax_pin* PinLookup::find(const Names& names, std::optional<bool> is_input) const {
  for (const std::string& name : names) {
    const parallax_pin* const found = pin(name);
    if (found == nullptr || taken_.count(found) > 0) continue;
    if (!is_input || (found->is_input != 0) == *is_input) return found;
  }
  return nullptr;
}

void PinLookup::take(const PinBits& bits) {
  std::vector<bool>& taken = taken_[&bits.pin()];
  if (taken.empty()) {
    taken.resize(bits.pin().width);
    if (bits.pin().is_input != 0) PinBits(bits.pin()).set(0);
  }
  std::fill_n(taken.begin() + static_cast<std::ptrdiff_t>(bits.low()), bits.width(), true);
}

void PinLookup::check_inputs() const {
  for (const parallax_pin& each : circuit_.pins()) {
    if (each.is_input == 0) continue;
    const auto found = taken_.find(&each);
    if (found == taken_.end()) {
      throw UserError(fmt::format(
          "circuit {}: nothing drives the input {} of {} bit{}; --circuit-pins ROLE={} says what it is, "
          "--circuit-set {}=VALUE what it is to be",
          circuit_.name(), each.name, each.width, each.width == 1 ? "" : "s", each.name, each.name));
    }
    const std::vector<bool>& bits = found->second;
    const auto open = std::find(bits.begin(), bits.end(), false);
    if (open == bits.end()) continue;
    const auto bit = open - bits.begin();
    throw UserError(
        fmt::format("circuit {}: nothing drives bit {} of the input {}; --circuit-pins ROLE={}[{}] says what "
                    "it is, --circuit-set {}[{}]=VALUE what it is to be",
                    circuit_.name(), bit, each.name, each.name, bit, each.name, bit));
  }
}

}  // namespace parallax
