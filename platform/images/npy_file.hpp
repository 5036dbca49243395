// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "platform/images/image_file.hpp"

namespace parallax {

/// Whether a file's bytes begin as those of an array of NumPy do (.npy).
bool is_npy(const std::vector<std::uint8_t>& bytes);

/// Reads a NumPy array of format version 1, 2 or 3 with the shape (rows, columns), where a side of 1 more is
/// left out: (1, rows, columns), (rows, columns, 1). The values are floating point of 16 to 64 bits, or
/// integers of 8 to 64 bits with or without sign, of either byte order, in C or Fortran order. The result has
/// one channel: CV_8U and CV_16U of unsigned integers, CV_32F of floating point of 16 or 32 bits, CV_64F of
/// all others. `name` is of the file, for messages. Throws UserError for what is none of that, a damaged
/// header, and another number of bytes than the shape asks for.
cv::Mat read_npy(const std::vector<std::uint8_t>& bytes, const std::string& name, const SizeCheck& check);

}  // namespace parallax
