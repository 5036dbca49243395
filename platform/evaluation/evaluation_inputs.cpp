// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/evaluation_inputs.hpp"

#include "platform/input/image_padding.hpp"
#include "platform/input/rectification_choice.hpp"
#include "platform/input/run_input.hpp"

namespace parallax {

EvaluationInput EvaluationInputs::prepare(const MachineConfig& config, const NoticeSink& notice) {
  const FrameSource& source = source_for(config, notice);
  EvaluationInput input;
  input.width = source.width();
  input.height = source.height();
  input.map = &map_for(config, source, notice);
  input.frames = source.frames();
  input.timing_frames = options_.timing_frames;
  if (options_.is_scene()) input.scene_seed = options_.scene.seed;
  return input;
}

const FrameSource& EvaluationInputs::source_for(const MachineConfig& config, const NoticeSink& notice) {
  const DisparityRange range = options_.is_scene() ? config.matching.range() : DisparityRange{};
  const ImageConfig& image = config.image;
  const ImageLimits largest = largest_images(config);
  const SourceKey key{image.width, image.height, largest.width, largest.height, range.offset, range.count};
  if (source_ == nullptr || key != source_key_) {
    source_ = open_source(options_, config, notice);
    source_key_ = key;
  }
  return *source_;
}

const EncodedMap& EvaluationInputs::map_for(const MachineConfig& config, const FrameSource& source,
                                            const NoticeSink& notice) {
  const cv::Size size(source.width(), source.height());
  const cv::Size processed = padded_size(size, config.image.granularity());
  const OffsetRange& range = config.rectification.range;
  const MapKey key{size.width,       size.height,  processed.width,
                   processed.height, range.window, range.fraction_bits};
  const auto found = maps_.find(key);
  if (found != maps_.end()) return found->second;
  if (const std::string line = padding_notice(size, config.image.granularity()); !line.empty()) notice(line);
  return maps_.emplace(key, choose_rectification(options_, range, source, processed, notice).map)
      .first->second;
}

}  // namespace parallax
