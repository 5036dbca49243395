// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "platform/images/image_file.hpp"

namespace parallax {

/// A portable float map of one channel.
struct PfmImage {
  cv::Mat values;    ///< CV_32FC1, the rows from the top down, as they are in the file
  double scale = 1;  ///< size of the number in the header; not applied
};

/// Whether a file's bytes begin as those of a portable float map do, grey (Pf) or colour (PF).
bool is_pfm(const std::vector<std::uint8_t>& bytes);

/// Reads a grey map; the sign of the header's scale says the byte order (negative: little-endian). `name` is
/// of the file, for messages. Throws UserError for a colour map, a damaged header, and another number of
/// bytes than the size asks for.
PfmImage read_pfm(const std::vector<std::uint8_t>& bytes, const std::string& name, const SizeCheck& check);

}  // namespace parallax
