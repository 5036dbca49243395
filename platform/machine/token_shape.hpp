// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "modules/path_step.hpp"
#include "modules/scan_order.hpp"
#include "modules/token_format.hpp"
#include "tlm/tap.hpp"

namespace parallax {

/// What the tokens of a stream are made of, and where they lie in the image.
struct TokenShape {
  TokenFormat format;
  /// Values of the tokens of a frame, where not all have as many as the format; what is missing is 0.
  std::vector<TapConfig::Run> runs{};
  /// Of a row of the image, or of a tile; 0: tokens that know no rows, as bytes of bursts.
  std::uint64_t row_tokens = 0;
  std::uint64_t tokens_per_pixel = 1;    ///< groups of costs
  std::uint64_t pixels_per_token = 1;    ///< fields name_0, name_1, ... of the format are neighbours of a row
  ScanOrder order = ScanOrder::kRaster;  ///< of the pixels
  std::optional<PathStep> path{};        ///< of the costs of one path
  /// Of costs: disparity (px) of a pixel's first field; each further field is one more.
  std::optional<int> first_disparity{};

  explicit TokenShape(TokenFormat of = {}) : format(std::move(of)) {}
};

/// The runs of pieces of `piece` values each that are cut into tokens of `token`, the last one of a piece
/// perhaps shorter.
std::vector<TapConfig::Run> cut_into_tokens(std::uint64_t piece, std::size_t token);

}  // namespace parallax
