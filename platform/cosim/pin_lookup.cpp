// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/pin_lookup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "platform/config/nearest_name.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

// "7" or "15:8", without the brackets: the highest and the lowest bit.
std::optional<std::pair<std::size_t, std::size_t>> read_range(const std::string& text) {
  const auto number = [](const std::string& digits) -> std::optional<std::size_t> {
    std::size_t value = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (digits.empty() || error != std::errc() || stop != digits.data() + digits.size()) return std::nullopt;
    return value;
  };
  const std::size_t colon = text.find(':');
  const auto high = number(text.substr(0, colon));
  const auto low = colon == std::string::npos ? high : number(text.substr(colon + 1));
  if (!high || !low || *high < *low) return std::nullopt;
  return std::pair{*high, *low};
}

}  // namespace

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
  const std::size_t bracket = word.find('[');
  const std::string name = word.substr(0, bracket);
  const parallax_pin* const found = pin(name);
  if (found == nullptr) {
    throw UserError(fmt::format("{}: circuit {} has no such pin; the nearest is {}", option, circuit_.name(),
                                nearest_name(name, names())));
  }
  if (bracket == std::string::npos) return PinBits(*found);
  const bool closed = word.back() == ']';
  const auto range = closed ? read_range(word.substr(bracket + 1, word.size() - bracket - 2)) : std::nullopt;
  if (!range) throw UserError(fmt::format("{}: a pin is PIN, PIN[BIT] or PIN[HIGH:LOW]", option));
  if (range->first >= found->width) {
    throw UserError(fmt::format("{}: pin {} of circuit {} has the bits {} to 0", option, name,
                                circuit_.name(), found->width - 1));
  }
  return PinBits(*found, range->second, range->first - range->second + 1);
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
