// SPDX-License-Identifier: Apache-2.0
#include "platform/input/frame_source.hpp"

#include <fmt/format.h>

#include <utility>

#include "platform/scene/scene.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

Calibration calibration_of(const SceneCalibration& scene) {
  Calibration calibration;
  calibration.source = "the built-in scene";
  calibration.model = scene.rectified ? LensModel::kRectified : LensModel::kPinhole;
  calibration.size = {scene.width, scene.height};
  const auto lens = [](const SceneLens& from) {
    return Lens{from.camera_matrix, {from.distortion.val, from.distortion.val + 5}};
  };
  calibration.left = lens(scene.left);
  calibration.right = lens(scene.right);
  calibration.R1 = scene.left.rectifying_rotation;
  calibration.R2 = scene.right.rectifying_rotation;
  calibration.P1 = scene.p1;
  calibration.P2 = scene.p2;
  calibration.geometry = geometry_of(scene.p1, scene.p2);
  calibration.unit = "m";
  return calibration;
}

class SceneSource final : public FrameSource {
 public:
  SceneSource(const SceneConfig& config, std::int64_t frames) : config_(config), frames_(frames) {
    config.validate();
  }

  std::int64_t frames() const override { return frames_; }
  int width() const override { return config_.width; }
  int height() const override { return config_.height; }
  std::string name() const override { return "the built-in scene"; }
  StereoImages load(std::int64_t frame) override { return scene().render(static_cast<int>(frame)); }
  std::optional<GroundTruth> truth(std::int64_t frame) override {
    const SceneTruth seen = scene().truth(static_cast<int>(frame));
    GroundTruth truth;
    truth.width = config_.width;
    truth.height = config_.height;
    constexpr float kStepsPerPixel = 256;
    truth.disparity.reserve(seen.disparity.total());
    for (auto it = seen.disparity.begin<std::uint16_t>(); it != seen.disparity.end<std::uint16_t>(); ++it)
      truth.disparity.push_back(static_cast<float>(*it) / kStepsPerPixel);
    truth.mask.assign(seen.mask.begin<std::uint8_t>(), seen.mask.end<std::uint8_t>());
    return truth;
  }
  std::optional<Calibration> calibration() const override {
    return calibration_of(scene_calibration(config_));
  }

 private:
  // Its textures and the rays of its cameras take time and memory; who asks for no image does without.
  const Scene& scene() {
    if (!scene_) scene_.emplace(config_);
    return *scene_;
  }

  SceneConfig config_;
  std::optional<Scene> scene_;
  std::int64_t frames_;
};

class FileSource final : public FrameSource {
 public:
  FileSource(std::vector<ImagePair> pairs, const ImageChoice& choice, const TruthFiles& truth,
             const NoticeSink& notice)
      : input_(std::move(pairs), choice, notice) {
    if (truth.truth.empty()) return;
    if (frames() > 1) {
      throw UserError(fmt::format(
          "--ground-truth is for one pair, but the input has {} frames; add --frames 1", frames()));
    }
    truth_ = read_ground_truth(truth, input_.width(), input_.height(), notice);
  }

  std::int64_t frames() const override { return input_.frames(); }
  int width() const override { return input_.width(); }
  int height() const override { return input_.height(); }
  std::string name() const override { return input_.paths(0).left.string(); }
  StereoImages load(std::int64_t frame) override { return input_.load(frame); }
  std::optional<GroundTruth> truth(std::int64_t) override { return truth_; }
  std::optional<Calibration> calibration() const override { return std::nullopt; }

 private:
  ImageInput input_;
  std::optional<GroundTruth> truth_;
};

}  // namespace

std::unique_ptr<FrameSource> scene_source(const SceneConfig& config, std::int64_t frames) {
  return std::make_unique<SceneSource>(config, frames);
}

std::unique_ptr<FrameSource> file_source(std::vector<ImagePair> pairs, const ImageChoice& choice,
                                         const TruthFiles& truth, const NoticeSink& notice) {
  return std::make_unique<FileSource>(std::move(pairs), choice, truth, notice);
}

}  // namespace parallax
