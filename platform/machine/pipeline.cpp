// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/pipeline.hpp"

#include <algorithm>
#include <initializer_list>
#include <optional>

#include "platform/machine/engine_config.hpp"

namespace parallax {
namespace {

constexpr std::int64_t kGrayBits = 8;
constexpr std::int64_t kDisparityBits = 12;

// The image is one piece, or each row of a tile is (StereoCore).
PixelUnpackConfig image_bursts(const TilePlan& tiles, const StageContext& context, PixelFormat format,
                               const DmaPortConfig& port) {
  PixelUnpackConfig config;
  config.format = format;
  config.width = static_cast<std::size_t>(context.width);
  config.burst = Bytes(port.burst_bytes);
  const std::uint64_t row = bytes_of(format, config.width);
  const auto rows = static_cast<std::uint64_t>(context.height);
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

// Bits of a sum of path costs: each path costs at most weighted code bits + P2 (matching.hpp).
std::int64_t cost_bits(const MachineConfig& config) {
  std::int64_t paths = 0;
  for (unsigned set = config.matching.paths; set != 0; set &= set - 1) ++paths;
  const std::int64_t largest =
      paths * (config.matching.cost_weight * config.census.code_bits() + config.matching.p2);
  std::int64_t bits = 1;
  while ((largest >> bits) != 0) ++bits;
  return bits;
}

}  // namespace

Pipeline::Store::Store(const std::string& what, const StoreLayout& layout, bool backwards,
                       const StageContext& context, const FifoConfig& fifo)
    : pack(("pack_" + what).c_str(), layout, context.clock, context.dataflow),
      unpack(("unpack_" + what).c_str(), layout, backwards, context.clock, context.dataflow),
      kept(("kept_" + what + "_bursts").c_str(), context.dataflow, context.clock, context.clock, fifo),
      returned(("returned_" + what + "_bursts").c_str(), context.dataflow, context.clock, context.clock,
               fifo) {
  pack.out_bursts(kept);
  unpack.in_bursts(returned);
}

template <class T>
Stream<T>& Pipeline::stream(const char* name, std::int64_t width_bits, std::uint64_t needed_depth) {
  FifoConfig fifo;
  fifo.depth = config_.streams.resolve(name, static_cast<std::uint32_t>(needed_depth));
  fifo.width = Bits(width_bits);
  fifo.kind = config_.streams.kind(name);
  fifo.synchroniser_stages = config_.streams.synchroniser_stages;
  auto made = std::make_unique<Stream<T>>(name, context_.dataflow, context_.clock, context_.clock, fifo);
  Stream<T>& reference = *made;
  streams_.push_back(std::move(made));
  return reference;
}

Pipeline::Pipeline(const sc_core::sc_module_name& name, const MachineConfig& config, const EncodedMap& map,
                   const TilePlan& tiles, const StageContext& context)
    : sc_module(name),
      config_(config),
      context_(context),
      tiles_(tiles.tiles.size()),
      store_(matcher_store(config, context.width, context.height)),
      parameters_(algorithm_parameters(config)),
      unpack_left_("unpack_left", image_bursts(tiles, context, config.camera.format, config.dma.left),
                   context.clock, context.dataflow),
      unpack_right_("unpack_right", image_bursts(tiles, context, config.camera.format, config.dma.right),
                    context.clock, context.dataflow),
      unpack_map_("unpack_map", map_bursts(map, config.dma.map), context.clock, context.dataflow),
      map_decoder_("map_decoder", map, Bytes(config.dma.map.data_bits / 8), config.timing.map_decoder,
                   context),
      rectification_("rectification", config.rectification, config.timing.rectification, context),
      census_("census", config.census, config.timing.census, context),
      matching_("matching", config.matching, config.census.code_bits(), config.timing.matching, context),
      subpixel_("subpixel", config.subpixel, config.matching.range(),
                static_cast<std::uint32_t>(config.matching.iterations), config.timing.subpixel, context),
      uniqueness_("uniqueness", config.uniqueness, config.matching.range(),
                  static_cast<std::uint32_t>(config.matching.iterations), config.timing.uniqueness, context),
      consistency_("consistency", config.consistency, config.matching.range(),
                   static_cast<std::uint32_t>(config.matching.iterations), config.timing.consistency,
                   context),
      texture_("texture", config.texture, config.timing.texture, context),
      speckle_("speckle", config.speckle, config.timing.speckle, context),
      gap_interpolation_("gap_interpolation", config.gap_interpolation, config.timing.gap_interpolation,
                         context),
      noise_reduction_("noise_reduction", config.noise_reduction, config.timing.noise_reduction, context),
      output_packing_("output_packing", packing(tiles, config.link.output_left(), config.dma.output),
                      context),
      left_bursts_("left_bursts", context.dataflow, context.clock, context.clock,
                   engine_config(config.dma.left).fifo()),
      right_bursts_("right_bursts", context.dataflow, context.clock, context.clock,
                    engine_config(config.dma.right).fifo()),
      map_bursts_("map_bursts", context.dataflow, context.clock, context.clock,
                  engine_config(config.dma.map).fifo()),
      output_bursts_("output_bursts", context.dataflow, context.clock, context.clock,
                     engine_config(config.dma.output).fifo()) {
  const PipelineTiming& time = config.timing;
  const auto groups = static_cast<std::uint64_t>(config.matching.iterations);
  const std::int64_t code_bits = 2 * config.census.code_bits();
  const std::int64_t group_bits = config.matching.parallelism * cost_bits(config);
  const std::int64_t offset_bits = 4 * config.rectification.range.offset_bits();

  // Paths that fork and meet again: the shorter one must hold what the longer one holds back, that is its
  // look-ahead in tokens, and what passes, at one token a cycle, during its pipeline latency, in its FIFOs,
  // and until the place in the shorter one's FIFO is free again.
  const auto through = [&](const char* fifo) {
    return std::uint64_t{config.streams.offsets(fifo).write_to_read};
  };
  const auto back = [&](const char* fifo) {
    return std::uint64_t{config.streams.offsets(fifo).read_to_write};
  };
  // For a long path: a token's way through its FIFOs and the place's way back in `shorter`; or, when that is
  // more, the places' ways back on the path itself as well, so that both paths hold about as much when it is
  // held up.
  const auto path = [&](const char* shorter, std::initializer_list<const char*> fifos) {
    std::uint64_t forth = 0;
    std::uint64_t returns = 0;
    for (const char* fifo : fifos) {
      forth += through(fifo);
      returns += back(fifo);
    }
    return forth + std::max(returns, back(shorter));
  };
  // Two streams side by side: the longer delay.
  const auto later = [&](const char* a, const char* b) {
    return through(a) + back(a) < through(b) + back(b) ? b : a;
  };
  const std::uint64_t to_uniqueness = groups - 1 + through("costs_subpixel") + time.subpixel.latency +
                                      through("winners") + back("costs_uniqueness");
  const std::uint64_t to_consistency =
      to_uniqueness + groups + time.uniqueness.latency + through("unique") + back("costs_consistency");
  const std::uint64_t disparities_ahead =
      census_.look_ahead() + matching_.look_ahead() + consistency_.look_ahead();
  const std::uint64_t to_texture =
      disparities_ahead + time.census.latency + time.matching.latency + time.subpixel.latency +
      time.uniqueness.latency + time.consistency.latency +
      path("left_texture", {later("left_rectified", "right_rectified"), later("left_codes", "right_codes"),
                            "costs_subpixel", "winners", "unique", "consistent"}) +
      groups;
  // The texture filter looks ahead too, on the image alone: what it is ahead of the disparities waits there.
  const std::uint64_t image_ahead = texture_.look_ahead();
  const std::uint64_t to_disparity =
      image_ahead > disparities_ahead
          ? image_ahead - disparities_ahead + through("left_texture") + back("consistent")
          : 0;
  const std::uint64_t to_output =
      std::max(to_texture, image_ahead + through("left_texture") + back("left_texture")) +
      speckle_.look_ahead() + gap_interpolation_.look_ahead() + noise_reduction_.look_ahead() +
      time.texture.latency + time.speckle.latency + time.gap_interpolation.latency +
      time.noise_reduction.latency +
      path("left_output", {"textured", "despeckled", "interpolated", "smoothed"});

  const auto connect = [](auto& out, auto& in, auto& between) {
    out(between);
    in(between);
  };
  unpack_left_.in_bursts(left_bursts_);
  unpack_right_.in_bursts(right_bursts_);
  unpack_map_.in_bursts(map_bursts_);
  connect(unpack_left_.out_tokens, rectification_.in_left, stream<Gray>("left_pixels", kGrayBits));
  connect(unpack_right_.out_tokens, rectification_.in_right, stream<Gray>("right_pixels", kGrayBits));
  connect(unpack_map_.out_tokens, map_decoder_.in_words,
          stream<std::uint8_t>("map_words", config.dma.map.data_bits));
  connect(map_decoder_.out_map, rectification_.in_map, stream<OffsetPair>("map_entries", offset_bits));
  connect(rectification_.out_left, census_.in_left, stream<Gray>("left_rectified", kGrayBits));
  connect(rectification_.out_right, census_.in_right, stream<Gray>("right_rectified", kGrayBits));
  connect(rectification_.out_left, texture_.in_left, stream<Gray>("left_texture", kGrayBits, to_texture));
  connect(rectification_.out_left, output_packing_.in_left,
          stream<Gray>("left_output", kGrayBits, to_output));
  connect(census_.out_left, matching_.in_left, stream<CensusCode>("left_codes", code_bits / 2));
  connect(census_.out_right, matching_.in_right, stream<CensusCode>("right_codes", code_bits / 2));
  connect(matching_.out_costs, subpixel_.in_costs, stream<Cost>("costs_subpixel", group_bits));
  connect(matching_.out_costs, uniqueness_.in_costs,
          stream<Cost>("costs_uniqueness", group_bits, to_uniqueness));
  connect(matching_.out_costs, consistency_.in_costs,
          stream<Cost>("costs_consistency", group_bits, to_consistency));
  connect(subpixel_.out_disparity, uniqueness_.in_disparity, stream<Disparity>("winners", kDisparityBits));
  connect(uniqueness_.out_disparity, consistency_.in_disparity, stream<Disparity>("unique", kDisparityBits));
  connect(consistency_.out_disparity, texture_.in_disparity,
          stream<Disparity>("consistent", kDisparityBits, to_disparity));
  connect(texture_.out_disparity, speckle_.in_disparity, stream<Disparity>("textured", kDisparityBits));
  connect(speckle_.out_disparity, gap_interpolation_.in_disparity,
          stream<Disparity>("despeckled", kDisparityBits));
  connect(gap_interpolation_.out_disparity, noise_reduction_.in_disparity,
          stream<Disparity>("interpolated", kDisparityBits));
  connect(noise_reduction_.out_disparity, output_packing_.in_disparity,
          stream<Disparity>("smoothed", kDisparityBits));
  output_packing_.out_bursts(output_bursts_);
  const FifoConfig buffer = engine_config(config.dma.buffer).fifo();
  if (store_.keeps_rows()) {
    rows_ = std::make_unique<Store>("rows", store_.rows, false, context, buffer);
    const auto bits = static_cast<std::int64_t>(
        8 * std::max(store_.rows.passes[0].record_bytes, store_.rows.passes[1].record_bytes));
    connect(*matching_.out_rows, rows_->pack.in_records, stream<std::uint8_t>("kept_rows", bits));
    connect(rows_->unpack.out_records, *matching_.in_rows, stream<std::uint8_t>("returned_rows", bits));
  }
  if (store_.keeps_frame()) {
    frame_ = std::make_unique<Store>("frame", store_.frame, true, context, buffer);
    const auto bits = static_cast<std::int64_t>(8 * store_.frame.passes[0].record_bytes);
    connect(*matching_.out_frame, frame_->pack.in_records, stream<std::uint8_t>("kept_frame", bits));
    connect(frame_->unpack.out_records, *matching_.in_frame, stream<std::uint8_t>("returned_frame", bits));
  }
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

StageInfo Pipeline::last_filter() const {
  return {&noise_reduction_, noise_reduction_.storage(), tiles_, config_.noise_reduction.enabled};
}

void Pipeline::configure(const AlgorithmParameters& parameters) {
  const bool changed = !(parameters == parameters_);
  parameters_ = parameters;
  const MachineConfig config = with_parameters(config_, parameters);
  const auto tell = [changed](auto& stage, const auto& part) {
    stage.configure(changed ? std::optional(part) : std::nullopt);
  };
  for (std::size_t pass = 0; pass < tiles_; ++pass) {
    tell(matching_, config.matching);
    tell(subpixel_, config.subpixel);
    tell(uniqueness_, config.uniqueness);
    tell(consistency_, config.consistency);
    tell(speckle_, config.speckle);
    tell(gap_interpolation_, config.gap_interpolation);
    tell(noise_reduction_, config.noise_reduction);
    const int threshold = config.texture.enabled ? config.texture.threshold : 0;
    texture_.set_threshold(changed ? std::optional(threshold) : std::nullopt);
  }
}

void Pipeline::keep_frames(std::size_t frames) {
  for (const StageInfo& info : stages()) const_cast<Stage*>(info.stage)->keep_frames(frames * info.passes);
}

std::vector<StageInfo> Pipeline::stages() const {
  // The map, and the results, of all tiles are one frame each.
  std::vector<StageInfo> all{
      {&unpack_left_, Bits(config_.dma.left.burst_bytes * 8), tiles_},
      {&unpack_right_, Bits(config_.dma.right.burst_bytes * 8), tiles_},
      {&unpack_map_, Bits(config_.dma.map.burst_bytes * 8)},
      {&map_decoder_, map_decoder_.storage()},
      {&rectification_, rectification_.storage(), tiles_},
      {&census_, census_.storage(), tiles_},
      {&matching_, matching_.storage(), tiles_},
      {&subpixel_, subpixel_.storage(), tiles_},
      {&uniqueness_, uniqueness_.storage(), tiles_, config_.uniqueness.enabled},
      {&consistency_, consistency_.storage(), tiles_, config_.consistency.enabled},
      {&texture_, texture_.storage(), tiles_, config_.texture.enabled},
      {&speckle_, speckle_.storage(), tiles_, config_.speckle.iterations > 0},
      {&gap_interpolation_, gap_interpolation_.storage(), tiles_, config_.gap_interpolation.enabled},
      last_filter(),
      {&output_packing_, output_packing_.storage()}};
  for (const Store* store : {rows_.get(), frame_.get()}) {
    if (store == nullptr) continue;
    const Bits burst(config_.dma.buffer.burst_bytes * 8);
    all.push_back({&store->pack, burst, tiles_});
    all.push_back({&store->unpack, burst, tiles_});
  }
  return all;
}

}  // namespace parallax
