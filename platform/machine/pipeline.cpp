// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/pipeline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "modules/census_stage.hpp"
#include "modules/consistency_stage.hpp"
#include "modules/map_decoder_stage.hpp"
#include "modules/matching_stage.hpp"
#include "modules/output_packing.hpp"
#include "modules/output_packing_stage.hpp"
#include "modules/pixel_unpack_stage.hpp"
#include "modules/rectification_stage.hpp"
#include "modules/store_stages.hpp"
#include "modules/subpixel_stage.hpp"
#include "modules/texture_stage.hpp"
#include "modules/token_formats.hpp"
#include "modules/uniqueness_stage.hpp"
#include "platform/machine/engine_config.hpp"
#include "platform/machine/matching_tap_ports.hpp"
#include "tlm/unpacker.hpp"

namespace parallax {
namespace {

// The image is one piece, or each row of a tile is (StereoCore).
PixelUnpackConfig image_bursts(const TilePlan& tiles, const StageContext& context, PixelFormat format,
                               const DmaPortConfig& port) {
  PixelUnpackConfig config;
  config.format = format;
  config.width = context.width;
  config.pixels = context.pixels_per_token;
  config.burst = Bytes(port.burst_bytes);
  const std::uint64_t row = bytes_of(format, config.width);
  const std::uint64_t rows = context.height;
  config.pieces = tiles.tiles.size() > 1 ? rows : 1;
  config.piece_bytes = row * rows / config.pieces;
  return config;
}

OutputPackingConfig packing(const TilePlan& tiles, OutputLeft left, const DmaPortConfig& port) {
  OutputPackingConfig config;
  config.left = left;
  config.burst = Bytes(port.burst_bytes);
  for (const Tile& tile : tiles.tiles) {
    config.passes.push_back({tile.keep_begin - tile.begin, tile.keep_end - tile.begin});
  }
  return config;
}

UnpackerConfig map_bursts(const EncodedMap& map, const DmaPortConfig& port) {
  return {map.bytes.size(), Bytes(port.burst_bytes), Bytes(port.data_bits / 8)};
}

// Tokens of bytes, of pieces that are cut anew.
TokenShape bytes(std::size_t token, std::vector<TapConfig::Run> runs) {
  TokenShape shape(word_format(token));
  shape.runs = std::move(runs);
  return shape;
}

TokenShape image_shape(const PixelUnpackConfig& config) {
  return bytes(config.burst.size(), cut_into_tokens(config.piece_bytes, config.burst.size()));
}

std::uint64_t bursts_of(const TokenShape& shape) {
  std::uint64_t bursts = 0;
  for (const TapConfig::Run& run : shape.runs) bursts += run.tokens;
  return bursts;
}

// What is kept of a tile's row is a piece; of the only tile, all of them are one.
TokenShape result_shape(const TilePlan& tiles, int height, const OutputPackingConfig& config) {
  const std::size_t burst = config.burst.size();
  std::vector<TapConfig::Run> runs;
  for (const Tile& tile : tiles.tiles) {
    const std::uint64_t row = OutputPacking::row_bytes(tile.keep_end - tile.keep_begin, config.left);
    const int pieces = tiles.tiles.size() > 1 ? height : 1;
    for (int piece = 0; piece < pieces; ++piece) {
      for (const TapConfig::Run& run : cut_into_tokens(row * height / pieces, burst)) runs.push_back(run);
    }
  }
  return bytes(burst, runs);
}

// Records of a pass may be shorter than those of another one.
TokenShape record_shape(const StoreLayout& layout, std::size_t record) {
  TokenShape shape(word_format(record));
  shape.row_tokens = layout.width;
  for (const StoreLayout::Pass& pass : layout.passes) {
    if (pass.record_bytes * pass.rows > 0)
      shape.runs.push_back({layout.width * pass.rows, static_cast<std::size_t>(pass.record_bytes)});
  }
  return shape;
}

Bits burst_bits(const DmaPortConfig& port) { return Bits(port.burst_bytes * 8); }

// Makes a stage follow the run-time parameters in a part of the configuration; not what stands in its place
// (nullptr).
template <class S, class Part>
void follow(std::vector<std::function<void(const MachineConfig*)>>& all, S* stage,
            Part MachineConfig::*part) {
  if (stage == nullptr) return;
  all.push_back([stage, part](const MachineConfig* next) {
    stage->configure(next != nullptr ? std::optional(next->*part) : std::nullopt);
  });
}

}  // namespace

Pipeline::Store::Store(const std::string& what, const StageContext& context, const FifoConfig& fifo)
    : kept(("kept_" + what + "_bursts").c_str(), context.dataflow, context.clock, context.clock, fifo),
      returned(("returned_" + what + "_bursts").c_str(), context.dataflow, context.clock, context.clock,
               fifo) {}

Pipeline::Pipeline(const sc_core::sc_module_name& name, const MachineConfig& config, const EncodedMap& map,
                   const TilePlan& tiles, const StageContext& context, const StageReplacements& replacements)
    : sc_module(name),
      config_(config),
      context_(context),
      tiles_(tiles.tiles.size()),
      store_(matcher_store(config, context.width, context.height)),
      parameters_(algorithm_parameters(config)),
      wiring_(config.streams, context, replacements),
      matching_taps_(std::make_unique<MatchingTaps>()),
      left_bursts_("left_bursts", context.dataflow, context.clock, context.clock,
                   engine_config(config.dma.left).fifo()),
      right_bursts_("right_bursts", context.dataflow, context.clock, context.clock,
                    engine_config(config.dma.right).fifo()),
      map_bursts_("map_bursts", context.dataflow, context.clock, context.clock,
                  engine_config(config.dma.map).fifo()),
      output_bursts_("output_bursts", context.dataflow, context.clock, context.clock,
                     engine_config(config.dma.output).fifo()) {
  place_inputs(map, tiles);
  place_matching();
  place_filters(tiles);
  connect_inputs(map, tiles);
  connect_matching();
  const std::string results = connect_filters(tiles);
  if (store_.keeps_rows()) rows_ = place_store("rows", store_.rows, false);
  if (store_.keeps_frame()) frame_ = place_store("frame", store_.frame, true);
  wiring_.build();
  results_ = &wiring_.stream<Disparity>(results);
  for (const auto& slot : wiring_.slots()) {
    if (!slot->content.takes_tokens && context.pixels_per_token > 1) {
      throw std::logic_error(
          fmt::format("what stands in the slot {} works in kernel time, value by value: "
                      "pipeline.pixels_per_token must be 1",
                      slot->name));
    }
    if (slot->content.follow) follow_.push_back(slot->content.follow);
  }
}

void Pipeline::place_inputs(const EncodedMap& map, const TilePlan& tiles) {
  const DmaConfig& dma = config_.dma;
  const PixelFormat format = config_.camera.format;
  const ClockDomain& clock = context_.clock;
  Dataflow& dataflow = context_.dataflow;
  // The map of all tiles is one frame, as the results are.
  wiring_.place<PixelUnpackStage>("unpack_left", {tiles_, true, 0, burst_bits(dma.left)},
                                  image_bursts(tiles, context_, format, dma.left), clock, dataflow);
  wiring_.place<PixelUnpackStage>("unpack_right", {tiles_, true, 0, burst_bits(dma.right)},
                                  image_bursts(tiles, context_, format, dma.right), clock, dataflow);
  wiring_.place<Unpacker<std::uint8_t>>("unpack_map", {1, true, 0, burst_bits(dma.map)},
                                        map_bursts(map, dma.map), clock, dataflow);
  wiring_.place<MapDecoderStage>("map_decoder", {}, map, Bytes(dma.map.data_bits / 8),
                                 config_.timing.map_decoder, context_);
  wiring_.place<RectificationStage>("rectification", {tiles_}, config_.rectification,
                                    config_.timing.rectification, context_);
}

void Pipeline::place_matching() {
  const PipelineTiming& time = config_.timing;
  const DisparityRange range = config_.matching.range();
  const CostGroups groups = config_.matching.groups(context_.pixels_per_token);
  wiring_.place<CensusStage>("census", {tiles_, config_.census.enabled}, config_.census, time.census,
                             context_);
  auto* matching = wiring_.place<MatchingStage>("matching", {tiles_, true, groups.of_token}, config_.matching,
                                                config_.census.code_bits(), time.matching, context_);
  auto* subpixel = wiring_.place<SubpixelStage>("subpixel", {tiles_, true, groups.of_token}, config_.subpixel,
                                                range, groups, time.subpixel, context_);
  auto* uniqueness =
      wiring_.place<UniquenessStage>("uniqueness", {tiles_, config_.uniqueness.enabled, groups.of_token},
                                     config_.uniqueness, range, groups, time.uniqueness, context_);
  auto* consistency =
      wiring_.place<ConsistencyStage>("consistency", {tiles_, config_.consistency.enabled, groups.of_token},
                                      config_.consistency, range, groups, time.consistency, context_);
  follow(follow_, matching, &MachineConfig::matching);
  follow(follow_, subpixel, &MachineConfig::subpixel);
  follow(follow_, uniqueness, &MachineConfig::uniqueness);
  follow(follow_, consistency, &MachineConfig::consistency);
}

void Pipeline::place_filters(const TilePlan& tiles) {
  auto* texture = wiring_.place<TextureStage>("texture", {tiles_, config_.texture.enabled}, config_.texture,
                                              config_.timing.texture, context_);
  follow(follow_, texture, &MachineConfig::texture);
  for (const auto& filter : config_.filters.all()) {
    wiring_.place(filter->name(), {tiles_, filter->enabled(config_)},
                  [&](const std::string& name, const StageContext& context) {
                    DisparityFilter::Made made = filter->make(name, config_, context);
                    SlotModule slot = slot_module(std::move(made.stage));
                    slot.follow = std::move(made.follow);
                    return slot;
                  });
  }
  if (const std::vector<StageInfo> before = stages(); !before.empty()) last_filter_ = before.back();
  wiring_.place<OutputPackingStage>("output_packing", {},
                                    packing(tiles, config_.link.output_left(), config_.dma.output), context_);
}

std::unique_ptr<Pipeline::Store> Pipeline::place_store(const std::string& what, const StoreLayout& layout,
                                                       bool backwards) {
  const DmaPortConfig& port = config_.dma.buffer;
  const Wiring::Facts facts{tiles_, true, 0, burst_bits(port)};
  wiring_.place<StorePackStage>("pack_" + what, facts, layout, context_.clock, context_.dataflow);
  wiring_.place<StoreUnpackStage>("unpack_" + what, facts, layout, backwards, context_.clock,
                                  context_.dataflow);
  auto store = std::make_unique<Store>(what, context_, engine_config(port).fifo());
  const TokenShape burst(word_format(port.burst_bytes));
  wiring_.attach(store->kept, burst, {"pack_" + what, "out_bursts"});
  wiring_.attach(store->returned, burst, {"unpack_" + what, "in_bursts"});
  std::uint64_t record_bytes = 0;
  for (const StoreLayout::Pass& pass : layout.passes) {
    record_bytes = std::max(record_bytes, pass.record_bytes);
  }
  const TokenShape record = record_shape(layout, record_bytes);
  wiring_.connect<std::uint8_t>("kept_" + what, record, {"matching", "out_" + what},
                                {"pack_" + what, "in_records"});
  wiring_.connect<std::uint8_t>("returned_" + what, record, {"unpack_" + what, "out_records"},
                                {"matching", "in_" + what});
  return store;
}

// One pixel after the other, of whose values `format` is one.
TokenShape Pipeline::raster(const TokenFormat& format) const {
  TokenShape shape(format.several(static_cast<std::size_t>(context_.pixels_per_token)));
  shape.row_tokens = context_.row_tokens();
  shape.pixels_per_token = static_cast<std::uint64_t>(context_.pixels_per_token);
  return shape;
}

// The sums of the matcher.
TokenShape Pipeline::cost_groups() const {
  TokenShape costs(cost_group_format(config_.matching.parallelism,
                                     summed_cost_bits(config_.matching, config_.census.code_bits()))
                       .several(config_.matching.parallel_rows));
  costs.row_tokens = context_.row_tokens() * config_.matching.groups(context_.pixels_per_token).of_token;
  costs.tokens_per_pixel = static_cast<std::uint64_t>(config_.matching.iterations);
  costs.first_disparity = config_.matching.disparity_offset;
  return costs;
}

void Pipeline::connect_inputs(const EncodedMap& map, const TilePlan& tiles) {
  const DmaConfig& dma = config_.dma;
  const auto attach_image = [&](Stream<std::uint8_t>& bursts, const DmaPortConfig& port, const char* unpack) {
    const PixelUnpackConfig image = image_bursts(tiles, context_, config_.camera.format, port);
    const TokenShape shape = image_shape(image);
    wiring_.attach(bursts, shape, {unpack, "in_bursts"}, bursts_of(shape) * image.pieces * tiles_);
  };
  const auto cut_map_into = [&map](std::size_t token) {
    return bytes(token, cut_into_tokens(map.bytes.size(), token));
  };
  const TokenShape gray = raster(gray_format());
  attach_image(left_bursts_, dma.left, "unpack_left");
  attach_image(right_bursts_, dma.right, "unpack_right");
  const TokenShape map_shape = cut_map_into(dma.map.burst_bytes);
  wiring_.attach(map_bursts_, map_shape, {"unpack_map", "in_bursts"}, bursts_of(map_shape));
  wiring_.connect<Gray>("left_pixels", gray, {"unpack_left", "out_tokens"}, {"rectification", "in_left"});
  wiring_.connect<Gray>("right_pixels", gray, {"unpack_right", "out_tokens"}, {"rectification", "in_right"});
  wiring_.connect<std::uint8_t>("map_words", cut_map_into(dma.map.data_bits / 8),
                                {"unpack_map", "out_tokens"}, {"map_decoder", "in_words"});
  wiring_.connect<OffsetPair>("map_entries",
                              raster(offset_pair_format(config_.rectification.range.offset_bits())),
                              {"map_decoder", "out_map"}, {"rectification", "in_map"}, Wiring::Reads::kLate);
  wiring_.connect<Gray>("left_rectified", gray, {"rectification", "out_left"}, {"census", "in_left"});
  wiring_.connect<Gray>("right_rectified", gray, {"rectification", "out_right"}, {"census", "in_right"});
  wiring_.connect<Gray>("left_texture", gray, {"rectification", "out_left"}, {"texture", "in_left"});
  wiring_.connect<Gray>("left_output", gray, {"rectification", "out_left"}, {"output_packing", "in_left"});
}

void Pipeline::connect_matching() {
  const TokenShape code =
      raster(config_.census.enabled ? census_code_format(config_.census.code_bits()) : gray_format());
  const TokenShape disparity = raster(disparity_format());
  const TokenShape costs = cost_groups();
  wiring_.connect<CensusCode>("left_codes", code, {"census", "out_left"}, {"matching", "in_left"});
  wiring_.connect<CensusCode>("right_codes", code, {"census", "out_right"}, {"matching", "in_right"});
  for (const char* stage : {"subpixel", "uniqueness", "consistency"}) {
    wiring_.connect<Cost>(std::string("costs_") + stage, costs, {"matching", "out_costs"},
                          {stage, "in_costs"}, Wiring::Reads::kAhead, true);
  }
  wiring_.connect<Disparity>("winners", disparity, {"subpixel", "out_disparity"},
                             {"uniqueness", "in_disparity"});
  wiring_.connect<Disparity>("unique", disparity, {"uniqueness", "out_disparity"},
                             {"consistency", "in_disparity"});
  wiring_.connect<Disparity>("consistent", disparity, {"consistency", "out_disparity"},
                             {"texture", "in_disparity"}, Wiring::Reads::kLate);
}

// From one filter to the next, and to the packing; returns the name of the last stream.
std::string Pipeline::connect_filters(const TilePlan& tiles) {
  const TokenShape disparity = raster(disparity_format());
  PortName from{"texture", "out_disparity"};
  std::string stream = "textured";
  for (const auto& filter : config_.filters.all()) {
    wiring_.connect<Disparity>(stream, disparity, from, {filter->name(), "in_disparity"});
    from = {filter->name(), "out_disparity"};
    stream = filter->stream();
  }
  wiring_.connect<Disparity>(stream, disparity, from, {"output_packing", "in_disparity"});
  const TokenShape shape =
      result_shape(tiles, context_.height, packing(tiles, config_.link.output_left(), config_.dma.output));
  wiring_.attach(output_bursts_, shape, {"output_packing", "out_bursts"}, bursts_of(shape));
  return stream;
}

void Pipeline::bind_rows(StreamIn<std::uint8_t>& kept, StreamOut<std::uint8_t>& returned) {
  kept(rows_->kept);
  returned(rows_->returned);
}

void Pipeline::bind_frame(StreamIn<std::uint8_t>& kept, StreamOut<std::uint8_t>& returned) {
  kept(frame_->kept);
  returned(frame_->returned);
}

void Pipeline::bind(StreamOut<std::uint8_t>& left, StreamOut<std::uint8_t>& right,
                    StreamOut<std::uint8_t>& map, StreamIn<std::uint8_t>& output) {
  left(left_bursts_);
  right(right_bursts_);
  map(map_bursts_);
  output(output_bursts_);
}

std::vector<TokenPort> Pipeline::taps(const std::string& slot) const {
  if (slot != "matching") return {};
  auto* const stage = dynamic_cast<MatchingStage*>(wiring_.slot(slot).content.module.get());
  if (stage == nullptr) return {};
  return matching_tap_ports(config_.matching, config_.census.code_bits(), cost_groups(), *stage,
                            *matching_taps_);
}

bool Pipeline::is_matcher(const Stage& stage) const { return std::string("matching") == stage.basename(); }

bool Pipeline::values_in_time() const {
  return std::all_of(wiring_.slots().begin(), wiring_.slots().end(),
                     [](const auto& slot) { return slot->content.stage != nullptr; });
}

void Pipeline::configure(const AlgorithmParameters& parameters) {
  const bool changed = !(parameters == parameters_);
  parameters_ = parameters;
  const MachineConfig config = with_parameters(config_, parameters);
  for (std::size_t pass = 0; pass < tiles_; ++pass) {
    for (const auto& follow : follow_) follow(changed ? &config : nullptr);
  }
}

void Pipeline::keep_frames(std::size_t frames) {
  for (const StageInfo& info : stages()) const_cast<Stage*>(info.stage)->keep_frames(frames * info.passes);
}

void Pipeline::pin_frame(std::size_t frame) {
  for (const StageInfo& info : stages()) const_cast<Stage*>(info.stage)->pin_frame(frame * info.passes);
}

std::vector<std::string> Pipeline::slots() const {
  std::vector<std::string> names;
  for (const auto& slot : wiring_.slots()) names.push_back(slot->name);
  return names;
}

std::vector<StageInfo> Pipeline::stages() const {
  std::vector<StageInfo> all;
  for (const auto& slot : wiring_.slots()) {
    if (slot->content.stage == nullptr) continue;
    all.push_back({slot->content.stage, slot->content.storage, slot->facts.passes, slot->facts.enabled});
    if (const Stage* const writing = slot->content.stage->writing_side()) {
      all.push_back({writing, Bits(0), slot->facts.passes, slot->facts.enabled});
    }
  }
  return all;
}

}  // namespace parallax
