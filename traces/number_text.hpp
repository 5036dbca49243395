// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace parallax {

/// A number for a reader: the one rule of rounding, for whatever the program prints. It has the decimals that
/// are usual for its unit (of a percentage or MB/s 1, of frames/s or W 2, of ms or px 3, of what is counted
/// 1; none where that, or pixels, are whole). It has more where it would be left with fewer than three digits
/// from the first that is not 0 and these are not all there is (0.1 frames/s are "0.10"), or where a share
/// below 100 % would read 100, and fewer where it would have more than seven digits. So "0.0" is nothing at
/// all, and "100.0" all. Below 0.0001 and from 10^12 on it has a power of ten; of something a second ("1/s")
/// it is in thousands, millions or billions.
std::string number_text(double value, std::string_view unit);

/// The same of a change, with its sign: "+4.69", and "0.0" where nothing changes.
std::string change_text(double value, std::string_view unit);

/// A number that somebody states, with the digits that he gives it: "100", "5.1 billion".
std::string stated_text(double value, std::string_view unit);

/// A number's text with its unit after it: "72.5 %", "3.942 billion/s"; frames/s are fps.
std::string with_unit(const std::string& number, std::string_view unit);

/// number_text() with its unit: "100.26 fps", "65.5 %".
std::string quantity_text(double value, std::string_view unit);

/// A number's text with its thousands apart: "1,228,800".
std::string grouped(std::string number);

}  // namespace parallax
