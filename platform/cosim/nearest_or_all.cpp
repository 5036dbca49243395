// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/nearest_or_all.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "platform/config/nearest_name.hpp"
#include "tlm/error.hpp"

namespace parallax {

std::string nearest_or_all(const std::string& word, const std::vector<std::string>& names) {
  constexpr std::size_t kLongest = 200;  // as nearest_name()
  const std::string nearest = nearest_name(word, names);
  if (word.size() <= kLongest && 2 * edit_distance(word, nearest) <= word.size())
    return "the nearest is " + nearest;
  return fmt::format("there {} {}", names.size() == 1 ? "is" : "are",
                     excerpt(fmt::format("{}", fmt::join(names, ", ")), 400));
}

}  // namespace parallax
