// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/pin_lookup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "platform/cosim/nearest_or_all.hpp"
#include "platform/cosim/signal_bits.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

// Whether ports may have one pin for both: what is the same of both, and is no data.
bool may_share(const std::string& one, const std::string& other) {
  static const std::set<std::string> of_all{"valid", "ready",  "first", "last",       "keep",
                                            "row",   "column", "group", "line_valid", "frame_valid"};
  const auto kind = [](const std::string& role) { return role.substr(role.find('.') + 1); };
  return kind(one) == kind(other) && of_all.count(kind(one)) > 0;
}

}  // namespace

const parallax_pin* PinLookup::pin(const std::string& name) const {
  for (const parallax_pin& each : circuit_.pins) {
    if (name == each.name) return &each;
  }
  return nullptr;
}

PinLookup::Names PinLookup::names() const {
  Names names;
  for (const parallax_pin& each : circuit_.pins) names.emplace_back(each.name);
  return names;
}

PinBits PinLookup::named(const std::string& word, const std::string& option) const {
  const auto bits = read_named_bits(word);
  if (!bits) throw UserError(fmt::format("{}: a pin is PIN, PIN[BIT] or PIN[HIGH:LOW]", option));
  const parallax_pin* const found = pin(bits->name);
  if (found == nullptr) {
    throw UserError(fmt::format("{}: circuit {} has no such pin; {}", option, circuit_.name,
                                nearest_or_all(bits->name, names())));
  }
  if (!bits->range) return PinBits(*found);
  const auto [high, low] = *bits->range;
  if (high >= found->width) {
    throw UserError(fmt::format("{}: pin {} of circuit {} has the bits {} to 0", option, bits->name,
                                circuit_.name, found->width - 1));
  }
  return PinBits(*found, low, high - low + 1);
}

const parallax_pin* PinLookup::find(const Names& names, std::optional<bool> is_input) const {
  for (const std::string& name : names) {
    const parallax_pin* const found = pin(name);
    if (found == nullptr || roles_.count(found) > 0) continue;
    if (!is_input || (found->is_input != 0) == *is_input) return found;
  }
  return nullptr;
}

void PinLookup::take(const PinBits& bits, const std::string& role) {
  std::vector<std::string>& roles = roles_[&bits.pin()];
  if (roles.empty()) {
    roles.resize(bits.pin().width);
    if (bits.pin().is_input != 0) PinBits(bits.pin()).set(0);
  }
  for (std::size_t bit = bits.low(); bit < bits.low() + bits.width(); ++bit) {
    if (!roles[bit].empty() && !may_share(roles[bit], role)) {
      throw UserError(
          fmt::format("circuit {}: pin {} is {} and {}; --circuit-pins ROLE=PIN gives each its own",
                      circuit_.name, bits.name(), roles[bit], role));
    }
    roles[bit] = role;
  }
}

std::vector<PinBits> PinLookup::unused(bool is_input) const {
  std::vector<PinBits> all;
  for (const parallax_pin& each : circuit_.pins) {
    if ((each.is_input != 0) != is_input) continue;
    const auto found = roles_.find(&each);
    if (found == roles_.end()) {
      all.emplace_back(each);
      continue;
    }
    if (!is_input) continue;
    const std::vector<std::string>& bits = found->second;
    for (std::size_t low = 0; low < bits.size(); ++low) {
      std::size_t end = low;
      while (end < bits.size() && bits[end].empty()) ++end;
      if (end == low) continue;
      all.emplace_back(each, low, end - low);
      low = end;
    }
  }
  return all;
}

}  // namespace parallax
