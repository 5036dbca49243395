// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

#include "modules/map_codec.hpp"
#include "modules/matching_taps.hpp"
#include "platform/config/machine_config.hpp"
#include "platform/machine/matcher_store.hpp"
#include "platform/machine/stage_info.hpp"
#include "platform/machine/stage_slot.hpp"
#include "platform/machine/tile_plan.hpp"
#include "platform/machine/wiring.hpp"
#include "platform/registers/algorithm_parameters.hpp"
#include "tlm/stream.hpp"

namespace parallax {

/// The stereo pipeline, from the bursts of the three input ports to those of the output port: the stages, and
/// the streams between them. This is the one place that knows which stage follows which.
class Pipeline final : public sc_core::sc_module {
 public:
  /// `map`: cut for the tiles (cut_map). `context` has the size of a tile. `replacements`: what stands in the
  /// place of stages; std::logic_error where it does not fit.
  Pipeline(const sc_core::sc_module_name& name, const MachineConfig& config, const EncodedMap& map,
           const TilePlan& tiles, const StageContext& context, const StageReplacements& replacements = {});

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
  /// Likewise those of the first pass over frame `frame`; see Stage::pin_frame().
  void pin_frame(std::size_t frame);

  /// For the next frame with values; each is told, in order.
  void configure(const AlgorithmParameters& parameters);

  /// The final disparities, on their way to the packing.
  Stream<Disparity>& results() const { return *results_; }
  /// The stage whose tokens are the final disparities (if that is a block in kernel time, the last one
  /// before).
  const StageInfo& last_filter() const { return last_filter_; }
  /// Whether `stage` stands in the slot of the matcher.
  bool is_matcher(const Stage& stage) const;
  /// Whether the values of all tokens come before their dates. Not where a block in kernel time, or a
  /// circuit, passes them on one by one: what works on rows behind it has them when the row is complete.
  bool values_in_time() const;
  /// Whether there is a block in kernel time, circuits apart.
  bool has_kernel_time_blocks() const { return wiring_.has_kernel_time_blocks(); }
  /// "frame 0, row 1": where a token of a stream lies; empty where that is not known.
  std::string place(const std::string& stream, std::uint64_t token) const {
    return wiring_.place(stream, token);
  }
  /// Upstream to downstream. Blocks in kernel time that replace stages are not among them.
  std::vector<StageInfo> stages() const;
  /// The names of the slots, upstream to downstream.
  std::vector<std::string> slots() const;
  /// std::logic_error for a slot that is not there.
  const SlotModule& slot(const std::string& name) const { return wiring_.slot(name).content; }
  /// The ports of what stands in a slot, inputs first; none of a slot that is not there.
  std::vector<TokenPort> ports(const std::string& slot) const { return wiring_.ports(slot); }
  /// What can be taken inside of the stage in a slot, as it can at its ports (matching_tap_ports.hpp): of the
  /// matcher.
  std::vector<TokenPort> taps(const std::string& slot) const;

 private:
  struct Store {  // streams between the matcher's slots and a pair of memory ports
    Store(const std::string& what, const StageContext& context, const FifoConfig& fifo);
    Stream<std::uint8_t> kept;
    Stream<std::uint8_t> returned;
  };

  void start_of_simulation() override { wiring_.check_frames(); }
  TokenShape raster(const TokenFormat& format) const;
  TokenShape cost_groups() const;
  void place_inputs(const EncodedMap& map, const TilePlan& tiles);
  void place_matching();
  void place_filters(const TilePlan& tiles);
  void connect_inputs(const EncodedMap& map, const TilePlan& tiles);
  void connect_matching();
  std::string connect_filters(const TilePlan& tiles);
  std::unique_ptr<Store> place_store(const std::string& what, const StoreLayout& layout, bool backwards);

  const MachineConfig& config_;
  const StageContext context_;
  const std::size_t tiles_;
  const MatcherStore store_;
  AlgorithmParameters parameters_;  // of the last frame that was told
  Wiring wiring_;
  const std::unique_ptr<MatchingTaps> matching_taps_;
  StageInfo last_filter_{};
  Stream<Disparity>* results_ = nullptr;
  std::vector<std::function<void(const MachineConfig* next)>> follow_;  // run-time parameters

  Stream<std::uint8_t> left_bursts_;
  Stream<std::uint8_t> right_bursts_;
  Stream<std::uint8_t> map_bursts_;
  Stream<std::uint8_t> output_bursts_;
  std::unique_ptr<Store> rows_;   // if it keeps rows
  std::unique_ptr<Store> frame_;  // if it keeps a frame
};

}  // namespace parallax
