// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace parallax {

/// What some editors put before UTF-8 text.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// All bytes of a file. Throws UserError when it cannot be read.
std::vector<std::uint8_t> read_file(const std::string& path);

}  // namespace parallax
