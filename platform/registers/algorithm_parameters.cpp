// SPDX-License-Identifier: Apache-2.0
#include "platform/registers/algorithm_parameters.hpp"

#include <tuple>

namespace parallax {
namespace {

auto all(const AlgorithmParameters& p) {
  return std::tie(p.p1, p.p2, p.mask_border, p.uniqueness, p.uniqueness_factor, p.consistency,
                  p.consistency_threshold, p.texture, p.texture_threshold, p.speckle_iterations,
                  p.gap_interpolation, p.noise_reduction);
}

}  // namespace

bool AlgorithmParameters::operator==(const AlgorithmParameters& other) const {
  return all(*this) == all(other);
}

AlgorithmParameters algorithm_parameters(const MachineConfig& config) {
  AlgorithmParameters p;
  p.p1 = config.matching.p1;
  p.p2 = config.matching.p2;
  p.mask_border = config.subpixel.mask_border;
  p.uniqueness = config.uniqueness.enabled;
  p.uniqueness_factor = config.uniqueness.factor;
  p.consistency = config.consistency.enabled;
  p.consistency_threshold = config.consistency.threshold;
  p.texture = config.texture.enabled;
  p.texture_threshold = config.texture.threshold;
  p.speckle_iterations = config.speckle.iterations;
  p.gap_interpolation = config.gap_interpolation.enabled;
  p.noise_reduction = config.noise_reduction.enabled;
  return p;
}

MachineConfig with_parameters(MachineConfig config, const AlgorithmParameters& p) {
  config.matching.p1 = p.p1;
  config.matching.p2 = p.p2;
  config.subpixel.mask_border = p.mask_border;
  config.uniqueness.enabled = p.uniqueness;
  config.uniqueness.factor = p.uniqueness_factor;
  config.consistency.enabled = p.consistency;
  config.consistency.threshold = p.consistency_threshold;
  config.texture.enabled = p.texture;
  config.texture.threshold = p.texture_threshold;
  config.speckle.iterations = p.speckle_iterations;
  config.gap_interpolation.enabled = p.gap_interpolation;
  config.noise_reduction.enabled = p.noise_reduction;
  return config;
}

}  // namespace parallax
