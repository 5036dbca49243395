// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/missing_pins.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tlm/error.hpp"

namespace parallax {
namespace {

using Words = std::vector<std::string>;

std::string sized(const std::string& name, std::size_t width) {
  return fmt::format("{} ({} bit{})", name, width, width == 1 ? "" : "s");
}

std::string listed(const Words& words) {
  constexpr std::size_t kMost = 600;
  return excerpt(fmt::format("{}", fmt::join(words, ", ")), kMost);
}

std::string pins_text(const std::vector<PinBits>& pins, const char* kind) {
  Words all;
  for (const PinBits& pin : pins) all.push_back(sized(pin.name(), pin.width()));
  return fmt::format("the {}{} {}", kind, pins.size() == 1 ? "" : "s", listed(all));
}

bool lacks(const std::vector<MissingPin>& missing, bool is_input) {
  return std::any_of(missing.begin(), missing.end(),
                     [is_input](const MissingPin& each) { return each.is_input == is_input; });
}

}  // namespace

void check_missing(const std::string& circuit, const std::string& stage,
                   const std::vector<MissingPin>& missing, const PinLookup& lookup) {
  const std::vector<PinBits> inputs = lookup.unused(true);
  if (missing.empty() && inputs.empty()) return;
  Words clauses;
  Words hints;
  if (!missing.empty()) {
    Words all;
    for (const MissingPin& each : missing) all.push_back(sized(each.role, each.width));
    std::string usual = missing[0].role;
    std::replace(usual.begin(), usual.end(), '.', '_');
    clauses.push_back(fmt::format("{} has no pin for {}, such as {}", stage, listed(all), usual));
    hints.push_back(fmt::format("--circuit-pins {}=PIN names it", missing[0].role));
  }
  if (!inputs.empty()) {
    clauses.push_back("nothing drives " + pins_text(inputs, "input"));
    const std::string name = inputs[0].name();
    hints.push_back(fmt::format(
        "--circuit-pins ROLE={} says what it is, --circuit-set {}=VALUE what it is to be", name, name));
  } else if (lacks(missing, true)) {
    clauses.push_back("no other input is there");
  }
  if (lacks(missing, false)) {
    const std::vector<PinBits> outputs = lookup.unused(false);
    clauses.push_back(outputs.empty() ? "no other output is there"
                                      : "nothing reads " + pins_text(outputs, "output"));
  }
  throw UserError(
      fmt::format("circuit {}: {}; {}", circuit, fmt::join(clauses, "; "), fmt::join(hints, "; ")));
}

}  // namespace parallax
