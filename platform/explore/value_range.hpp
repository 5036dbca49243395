// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace parallax {

/// The numbers of a range "start:stop:step": from start in steps towards stop, which is one of them where a
/// step meets it. As text, computed in decimal, so that 0:1:0.1 has a 0.3; in powers of ten where all three
/// are written so with the same exponent ("125e6:200e6:25e6"). Throws UserError, quoting the range: not of
/// this form, a step of zero or away from stop, more than `most` numbers, or numbers of more than 17 digits.
std::vector<std::string> range_values(const std::string& text, std::size_t most);

}  // namespace parallax
