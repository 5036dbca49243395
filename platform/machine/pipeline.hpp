// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

#include "modules/census_stage.hpp"
#include "modules/consistency_stage.hpp"
#include "modules/gap_interpolation_stage.hpp"
#include "modules/map_codec.hpp"
#include "modules/map_decoder_stage.hpp"
#include "modules/matching_stage.hpp"
#include "modules/noise_reduction_stage.hpp"
#include "modules/output_packing_stage.hpp"
#include "modules/pixel_unpack_stage.hpp"
#include "modules/rectification_stage.hpp"
#include "modules/speckle_stage.hpp"
#include "modules/store_stages.hpp"
#include "modules/subpixel_stage.hpp"
#include "modules/texture_stage.hpp"
#include "modules/uniqueness_stage.hpp"
#include "platform/config/machine_config.hpp"
#include "platform/machine/matcher_store.hpp"
#include "platform/machine/stage_info.hpp"
#include "platform/machine/tile_plan.hpp"
#include "platform/registers/algorithm_parameters.hpp"
#include "tlm/dma.hpp"
#include "tlm/unpacker.hpp"

namespace parallax {

/// The stereo pipeline, from the bursts of the three input ports to those of the output port: the stages, and
/// the streams between them. This is the one place that knows which stage follows which.
class Pipeline final : public sc_core::sc_module {
 public:
  /// `map`: cut for the tiles (cut_map). `context` has the size of a tile.
  Pipeline(const sc_core::sc_module_name& name, const MachineConfig& config, const EncodedMap& map,
           const TilePlan& tiles, const StageContext& context);

  /// Binds the ports that bring the left image, the right image and the map in bursts, and the one that takes
  /// the results.
  void bind(StreamOut<std::uint8_t>& left, StreamOut<std::uint8_t>& right, StreamOut<std::uint8_t>& map,
            StreamIn<std::uint8_t>& output);
  /// The same for what the matcher keeps in memory: the ports that take it and bring it back.
  void bind_rows(StreamIn<std::uint8_t>& kept, StreamOut<std::uint8_t>& returned);
  void bind_frame(StreamIn<std::uint8_t>& kept, StreamOut<std::uint8_t>& returned);
  const MatcherStore& store() const { return store_; }

  /// Of every stage, the dates of the first and the last `frames` frames are kept; see Stage::keep_frames().
  void keep_frames(std::size_t frames);

  /// For the next frame with values; each is told, in order.
  void configure(const AlgorithmParameters& parameters);

  OutputPackingStage& output() { return output_packing_; }
  /// The stage whose tokens are the final disparities.
  StageInfo last_filter() const;
  const Stage& matcher() const { return matching_; }
  std::vector<StageInfo> stages() const;

 private:
  struct Store {  // between the matcher and a pair of memory ports
    Store(const std::string& what, const StoreLayout& layout, bool backwards, const StageContext& context,
          const FifoConfig& fifo);
    StorePackStage pack;
    StoreUnpackStage unpack;
    Stream<std::uint8_t> kept;
    Stream<std::uint8_t> returned;
  };

  template <class T>
  Stream<T>& stream(const char* name, std::int64_t width_bits, std::uint64_t needed_depth = 0);

  const MachineConfig& config_;
  const StageContext context_;
  const std::size_t tiles_;
  const MatcherStore store_;
  AlgorithmParameters parameters_;  // of the last frame that was told

  PixelUnpackStage unpack_left_;
  PixelUnpackStage unpack_right_;
  Unpacker<std::uint8_t> unpack_map_;
  MapDecoderStage map_decoder_;
  RectificationStage rectification_;
  CensusStage census_;
  MatchingStage matching_;
  SubpixelStage subpixel_;
  UniquenessStage uniqueness_;
  ConsistencyStage consistency_;
  TextureStage texture_;
  SpeckleStage speckle_;
  GapInterpolationStage gap_interpolation_;
  NoiseReductionStage noise_reduction_;
  OutputPackingStage output_packing_;

  Stream<std::uint8_t> left_bursts_;
  Stream<std::uint8_t> right_bursts_;
  Stream<std::uint8_t> map_bursts_;
  Stream<std::uint8_t> output_bursts_;
  std::unique_ptr<Store> rows_;   // if it keeps rows
  std::unique_ptr<Store> frame_;  // if it keeps a frame
  std::vector<std::unique_ptr<StreamBase>> streams_;
};

}  // namespace parallax
