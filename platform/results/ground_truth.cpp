// SPDX-License-Identifier: Apache-2.0
#include "platform/results/ground_truth.hpp"

#include <cmath>

#include "platform/images/image_file.hpp"
#include "platform/results/disparity_view.hpp"
#include "tlm/error.hpp"
#include "tlm/units.hpp"

namespace parallax {

namespace {

constexpr std::uint8_t kScored = 255;

}  // namespace

bool GroundTruth::scored(std::size_t pixel) const {
  return disparity[pixel] != 0 && (mask.empty() || mask[pixel] == kScored);
}

double GroundTruth::error(std::size_t pixel, const Disparity& found) const {
  return std::abs(in_pixels(found) - double{disparity[pixel]});
}

GroundTruthScore score(const std::vector<Disparity>& disparity, int width, const GroundTruth& truth) {
  if (width != truth.width || disparity.size() != truth.disparity.size()) {
    const int height = width > 0 ? static_cast<int>(disparity.size()) / width : 0;
    throw UserError("the ground truth is " + size_text({truth.width, truth.height}) +
                    ", the disparities are " + size_text({width, height}));
  }
  GroundTruthScore result;
  result.pixels = disparity.size();
  for (std::size_t i = 0; i < disparity.size(); ++i) {
    if (!truth.scored(i)) continue;
    ++result.scored;
    if (!disparity[i].valid()) continue;
    ++result.valid;
    const double error = truth.error(i, disparity[i]);
    result.absolute_error += error;
    for (int limit = 1; limit <= GroundTruthScore::kLimits; ++limit) {
      result.bad[limit - 1] += error > limit;
    }
  }
  return result;
}

double GroundTruthScore::coverage() const { return quotient(valid, scored); }

double GroundTruthScore::bad_share(int limit) const { return quotient(bad.at(limit - 1), valid); }

double GroundTruthScore::bad_share_all(int limit) const {
  return quotient(bad.at(limit - 1) + scored - valid, scored);
}

double GroundTruthScore::mean_error() const { return quotient(absolute_error, valid); }

GroundTruthScore& GroundTruthScore::operator+=(const GroundTruthScore& other) {
  pixels += other.pixels;
  scored += other.scored;
  valid += other.valid;
  for (std::size_t i = 0; i < bad.size(); ++i) bad[i] += other.bad[i];
  absolute_error += other.absolute_error;
  return *this;
}

std::vector<Quality> GroundTruthScore::qualities() const {
  std::vector<Quality> result = {
      {"scored_pixels", static_cast<double>(scored)},
      {"valid_pixels", static_cast<double>(valid)},
      {"coverage", 100 * coverage()},
      {"mean_error", mean_error()},
  };
  for (int limit = 1; limit <= kLimits; ++limit) {
    const std::string n = std::to_string(limit);
    result.push_back({"bad_" + n, 100 * bad_share(limit)});
    result.push_back({"bad_" + n + "_all", 100 * bad_share_all(limit)});
  }
  return result;
}

}  // namespace parallax
