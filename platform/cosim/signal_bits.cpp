// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/signal_bits.hpp"

#include <charconv>

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

std::optional<NamedBits> read_named_bits(const std::string& word) {
  const std::size_t bracket = word.rfind('[');
  // Of a scope, else.
  if (bracket == std::string::npos || word.find('.', bracket) != std::string::npos)
    return NamedBits{word, std::nullopt};
  if (word.back() != ']') return std::nullopt;
  const auto range = read_range(word.substr(bracket + 1, word.size() - bracket - 2));
  if (!range) return std::nullopt;
  return NamedBits{word.substr(0, bracket), range};
}

bool is_padded_tdata(const std::string& name, std::size_t signal_width, std::size_t width) {
  constexpr std::size_t kTdataStep = 8;
  return signal_width == (width + kTdataStep - 1) / kTdataStep * kTdataStep && ends_with(name, "tdata");
}

bool ends_with(const std::string& name, const std::string& ending) {
  return name.size() >= ending.size() &&
         name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

}  // namespace parallax
