// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/token_shape.hpp"

namespace parallax {

std::vector<TapConfig::Run> cut_into_tokens(std::uint64_t piece, std::size_t token) {
  std::vector<TapConfig::Run> runs;
  if (piece / token > 0) runs.push_back({piece / token, token});
  if (piece % token > 0) runs.push_back({1, piece % token});
  return runs;
}

}  // namespace parallax
