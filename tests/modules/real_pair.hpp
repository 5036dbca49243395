// SPDX-License-Identifier: Apache-2.0
// Real stereo pairs from outside the repository, and all kernels of the matching chain in a row.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "modules/census.hpp"
#include "modules/consistency.hpp"
#include "modules/matching.hpp"
#include "modules/subpixel.hpp"
#include "modules/uniqueness.hpp"
#include "platform/images/image_codecs.hpp"
#include "tests/modules/images.hpp"
#include "tests/paths.hpp"

namespace parallax::test {

/// An empty image if there is no such file.
inline cv::Mat load_shared(const std::string& name, int flags = cv::IMREAD_GRAYSCALE) {
  return read_image(shared_data(name), flags);
}

inline Grid<Gray> to_grid(const cv::Mat& image) {
  Grid<Gray> grid(image.cols, image.rows);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) grid.at(x, y) = image.at<Gray>(y, x);
  }
  return grid;
}

struct ChainConfig {
  CensusConfig census;
  MatchingConfig matching;
  SubpixelConfig subpixel;
  UniquenessConfig uniqueness;
  ConsistencyConfig consistency;
};

inline Grid<Disparity> run_chain(const ChainConfig& config, const Grid<Gray>& left, const Grid<Gray>& right) {
  const int w = left.width;
  const int h = left.height;
  const DisparityRange range = config.matching.range();
  const auto codes = [&](const Grid<Gray>& image) {
    Census census(config.census, w, h);
    return collect<CensusCode>(w, h, 1, [&](int y, const auto& emit) { census.push(image.row(y), emit); });
  };
  const Grid<CensusCode> left_codes = codes(left);
  const Grid<CensusCode> right_codes = codes(right);
  Matching matching(config.matching, w, h, config.census.code_bits());
  Subpixel subpixel(config.subpixel, range, w, h);
  Uniqueness uniqueness(config.uniqueness, range, w, h);
  Consistency consistency(config.consistency, range, w, h);
  return collect<Disparity>(w, h, 1, [&](int y, const RowSink<Disparity>& emit) {
    matching.push(left_codes.row(y), right_codes.row(y), [&](const Cost* costs) {
      subpixel.push(costs, [&](const Disparity* refined) {
        uniqueness.push(costs, refined,
                        [&](const Disparity* unique) { consistency.push(costs, unique, emit); });
      });
    });
  });
}

}  // namespace parallax::test
