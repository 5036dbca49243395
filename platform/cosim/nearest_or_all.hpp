// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace parallax {

/// "the nearest is clk" of what there is, if that is near: if no more than half of the word is another; else
/// "there are clk, rst, pixel_i".
std::string nearest_or_all(const std::string& word, const std::vector<std::string>& names);

}  // namespace parallax
