// SPDX-License-Identifier: Apache-2.0
// The stages from a rectified pair to the disparity image, one after the other, without time.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "modules/census.hpp"
#include "modules/consistency.hpp"
#include "modules/gap_interpolation.hpp"
#include "modules/matching.hpp"
#include "modules/noise_reduction.hpp"
#include "modules/speckle.hpp"
#include "modules/subpixel.hpp"
#include "modules/texture.hpp"
#include "modules/uniqueness.hpp"
#include "platform/config/configuration.hpp"
#include "tests/paths.hpp"

namespace parallax::test {

/// The shipped preset, as the program runs it.
inline MachineConfig shipped_config() {
  return load_configuration({}, {source_path("platform/presets")}).machine;
}

inline std::vector<CensusCode> census_of(const CensusConfig& config, const cv::Mat& image) {
  std::vector<CensusCode> codes;
  Census census(config, image.cols, image.rows);
  for (int y = 0; y < image.rows; ++y) {
    census.push(image.ptr<Gray>(y),
                [&](const CensusCode* row) { codes.insert(codes.end(), row, row + image.cols); });
  }
  return codes;
}

inline std::vector<Disparity> run_chain(const MachineConfig& config, const cv::Mat& left,
                                        const cv::Mat& right) {
  const int width = left.cols;
  const int height = left.rows;
  const DisparityRange range = config.matching.range();
  const std::vector<CensusCode> left_codes = census_of(config.census, left);
  const std::vector<CensusCode> right_codes = census_of(config.census, right);
  Matching matching(config.matching, width, height, config.census.code_bits());
  Subpixel subpixel(config.subpixel, range, width, height);
  Uniqueness uniqueness(config.uniqueness, range, width, height);
  Consistency consistency(config.consistency, range, width, height);
  Texture texture(config.texture, width, height);
  Speckle speckle(config.speckle, width, height);
  GapInterpolation gap_interpolation(config.gap_interpolation, width, height);
  NoiseReduction noise_reduction(config.noise_reduction, width, height);

  std::vector<Disparity> output;
  const auto collect = [&](const Disparity* row) { output.insert(output.end(), row, row + width); };
  const auto after_gaps = [&](const Disparity* row) { noise_reduction.push(row, collect); };
  const auto after_speckle = [&](const Disparity* row) { gap_interpolation.push(row, after_gaps); };
  const auto after_texture = [&](const Disparity* row) { speckle.push(row, after_speckle); };
  const auto after_consistency = [&](const Disparity* row) { texture.push_disparity(row, after_texture); };
  const auto after_matching = [&](const Cost* costs) {
    subpixel.push(costs, [&](const Disparity* winners) {
      uniqueness.push(costs, winners,
                      [&](const Disparity* unique) { consistency.push(costs, unique, after_consistency); });
    });
  };
  for (int y = 0; y < height; ++y) {
    texture.push_image(left.ptr<Gray>(y), after_texture);
    const std::size_t begin = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    matching.push(left_codes.data() + begin, right_codes.data() + begin, after_matching);
  }
  return output;
}

}  // namespace parallax::test
