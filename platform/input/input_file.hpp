// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace parallax {

/// What some editors put before UTF-8 text.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// The longest file that is read as a whole: four times the largest of raw maps as text, and soon reached
/// where a file has no end.
constexpr std::size_t kMostFileBytes = std::size_t{512} << 20;

/// All bytes of a file. Throws UserError when it is none (plain_file.hpp), cannot be read, or has more than
/// `most`.
std::vector<std::uint8_t> read_file(const std::string& path, std::size_t most = kMostFileBytes);

}  // namespace parallax
