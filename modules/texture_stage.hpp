// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <systemc>

#include "modules/frame_changes.hpp"
#include "modules/raster_schedule.hpp"
#include "modules/texture.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// Texture filter: rectified left pixels in, half a window ahead of the disparities that they judge
/// (texture.hpp; paper, "Texture Filtering").
class TextureStage final : public Stage {
 public:
  StreamIn<Gray> in_left{"in_left"};
  StreamIn<Disparity> in_disparity{"in_disparity"};
  StreamOut<Disparity> out_disparity{"out_disparity"};

  TextureStage(const sc_core::sc_module_name& name, const TextureConfig& config, const StageTiming& timing,
               const StageContext& context);

  /// The configuration for the next frame that has none yet, or none: as before. Only the threshold may
  /// change, and whether a filter that was built on is.
  void configure(const std::optional<TextureConfig>& config) { changes_.push(config); }
  /// Into the image; disparities are not looked ahead to.
  std::uint64_t look_ahead() const { return look_ahead_; }
  Bits storage() const { return storage_; }

 private:
  Texture kernel_;
  FrameChanges<TextureConfig> changes_;  // by the image, which comes first
  std::uint64_t look_ahead_;
  Bits storage_;
};

}  // namespace parallax
