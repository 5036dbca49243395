// SPDX-License-Identifier: Apache-2.0
#include "platform/input/pinhole_camera.hpp"

#include <fmt/format.h>

#include "platform/input/quoted_text.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr std::size_t kNoDistortion = 4;  // coefficients of a lens without, all 0

ImageSize resolution(const YamlEntries& camera) {
  const std::vector<double> size = camera.matrix("resolution", 1, 2);
  return image_size(size[0], size[1], camera.where("resolution"));
}

LensModel pinhole_distortion(const YamlEntries& camera) {
  const std::string projection = camera.text("camera_model");
  if (projection != "pinhole") {
    throw UserError(fmt::format("{}: {} is not supported, only pinhole", camera.where("camera_model"),
                                in_quotes(projection)));
  }
  const std::string name = camera.text("distortion_model");
  if (name == "none") return LensModel::kPinhole;
  if (const std::optional<LensModel> model = distortion_model(name)) return *model;
  throw UserError(fmt::format("{}: {} is not supported, only radtan, equidistant and none",
                              camera.where("distortion_model"), in_quotes(name)));
}

StatedCalibration::StatedLens pinhole_lens(const YamlEntries& camera, const std::string& coefficients) {
  const std::vector<double> f = camera.matrix("intrinsics", 1, 4);
  StatedCalibration::StatedLens lens;
  lens.camera_name = camera.where("intrinsics");
  lens.distortion_name = camera.where(coefficients);
  lens.lens.camera = {f[0], 0, f[2], 0, f[1], f[3], 0, 0, 1};
  if (camera.text("distortion_model") == "none") {
    lens.lens.distortion.assign(kNoDistortion, 0);
  } else {
    lens.lens.distortion = camera.numbers(coefficients);
  }
  return lens;
}

}  // namespace

StatedCalibration pinhole_pair(const YamlEntries& left, const YamlEntries& right,
                               const std::string& coefficients) {
  StatedCalibration pair;
  pair.model = pinhole_distortion(left);
  pair.size = resolution(left);
  const ImageSize other = resolution(right);
  if (pair.size.width != other.width || pair.size.height != other.height) {
    throw UserError(fmt::format("{}: {}x{}, but the left camera has {}x{}; those of a pair have one size",
                                right.where("resolution"), other.width, other.height, pair.size.width,
                                pair.size.height));
  }
  if (pair.model != pinhole_distortion(right)) {
    throw UserError(fmt::format("{}: {}, but the left camera has {}; both lenses of a pair are of one model",
                                right.where("distortion_model"), right.text("distortion_model"),
                                left.text("distortion_model")));
  }
  pair.left = pinhole_lens(left, coefficients);
  pair.right = pinhole_lens(right, coefficients);
  return pair;
}

}  // namespace parallax
