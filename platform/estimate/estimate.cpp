// SPDX-License-Identifier: Apache-2.0
#include "platform/estimate/estimate.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "modules/token_formats.hpp"
#include "platform/estimate/declared_circuits.hpp"
#include "platform/estimate/pipeline_plan.hpp"
#include "platform/estimate/reference_circuits.hpp"
#include "platform/machine/matcher_store.hpp"
#include "platform/machine/tile_plan.hpp"

namespace parallax {
namespace {

using Kind = PartEstimate::Kind;

int paths_of(unsigned set) {
  int number = 0;
  for (; set != 0; set &= set - 1) ++number;
  return number;
}

class Estimator {
 public:
  Estimator(const MachineConfig& config, const DeviceFile& device, int width, int height)
      : config_(config), device_(device), width_(width), height_(height) {}

  ResourceEstimate made() {
    add_inputs();
    add_matching();
    add_filters();
    add_streams();
    add_engines();
    std::stable_sort(result_.parts.begin(), result_.parts.end(),
                     [](const PartEstimate& a, const PartEstimate& b) { return a.kind < b.kind; });
    for (const PartEstimate& part : result_.parts) result_.total += part.resources;
    return std::move(result_);
  }

 private:
  enum class Basis { kReference, kDeclared };

  StageCircuit circuit(const StageTiming& timing) const {
    return {width_, height_, static_cast<int>(timing.latency), config_.timing.pixels_per_token};
  }

  void add_stage(const std::string& name, const CircuitEstimate& circuit, Basis basis) {
    const bool calibrated = basis == Basis::kReference && device_.calibrated;
    result_.parts.push_back({Kind::kStage, name, "", "", {}, circuit.logic, calibrated});
    for (const CircuitMemory& memory : circuit.memories)
      result_.parts.push_back({Kind::kBuffer, memory.name, name, "", {}, memory.resources, calibrated});
  }
  // Where several pixels pass at once, or rows do, no reference circuit shows how much the copies share.
  Basis basis_of_one() const {
    return config_.timing.pixels_per_token == 1 && config_.matching.parallel_rows == 1 ? Basis::kReference
                                                                                       : Basis::kDeclared;
  }

  // A window of one pixel moves nothing: such a machine has neither a map nor what reads it.
  bool rectifies() const { return config_.rectification.range.window > 1; }

  void add_burst_stage(const std::string& name, const DmaPortConfig& port, std::int64_t token_bits) {
    CircuitEstimate made = burst_circuit(port, token_bits, device_);
    for (CircuitMemory& memory : made.memories) memory.name = name + "_" + memory.name;
    add_stage(name, made, Basis::kDeclared);
  }

  void add_inputs();
  void add_matching();
  void add_filters();
  void add_streams();
  void add_engines();
  MatchingCircuit matching() const;

  const MachineConfig& config_;
  const DeviceFile& device_;
  const int width_;
  const int height_;
  ResourceEstimate result_;
};

void Estimator::add_inputs() {
  const std::int64_t pixels = config_.timing.pixels_per_token;
  const std::int64_t grey = pixels * gray_format().width().count();
  const int offset_bits = static_cast<int>(config_.rectification.range.offset_bits());
  const auto map_word = static_cast<int>(config_.dma.map.data_bits);
  add_burst_stage("unpack_left", config_.dma.left, grey);
  add_burst_stage("unpack_right", config_.dma.right, grey);
  if (rectifies()) {
    add_burst_stage("unpack_map", config_.dma.map, map_word);
    add_stage("map_decoder",
              map_decoder_circuit(circuit(config_.timing.map_decoder), offset_bits, map_word, device_),
              Basis::kDeclared);
    const OffsetRange& range = config_.rectification.range;
    add_stage("rectification",
              rectification_circuit({circuit(config_.timing.rectification), range.window,
                                     static_cast<int>(range.fraction_bits), offset_bits},
                                    device_),
              basis_of_one());
  }
  if (!config_.census.enabled) return;
  add_stage("census",
            census_circuit(
                {circuit(config_.timing.census), config_.census.window_width, config_.census.window_height},
                device_),
            basis_of_one());
}

MatchingCircuit Estimator::matching() const {
  const MatchingConfig& m = config_.matching;
  const int code_bits = config_.census.code_bits();
  MatchingCircuit c;
  c.stage = circuit(config_.timing.matching);
  c.parallelism = m.parallelism;
  c.iterations = m.iterations;
  c.code_bits = code_bits;
  c.cost_bits = pixel_cost_bits(m, code_bits);
  c.path_bits = path_cost_bits(m, code_bits);
  c.sum_bits = summed_cost_bits(m, code_bits);
  c.window = m.range().last() + 1;
  c.horizontal_paths = paths_of(m.paths & (kPathW | kPathE));
  // The second pass runs after the first one, through the same circuits.
  c.line_paths =
      std::max(paths_of(m.paths & (kPathNW | kPathN | kPathNE)), paths_of(m.paths & kSouthernPaths));
  c.lines_on_chip = m.path_storage == PathStorage::kOnChip;
  c.rows_at_once = m.parallel_rows;
  c.keeps_row = (m.paths & kPathE) != 0;
  return c;
}

void Estimator::add_matching() {
  const MatchingConfig& m = config_.matching;
  const bool as_reference = (m.paths & ~kFourPaths) == 0 && m.path_storage == PathStorage::kOnChip &&
                            m.cost == MatchingCost::kHamming && m.recurrence_order == RecurrenceOrder::kPlain;
  const MatchingCircuit c = matching();
  add_stage("matching", matching_circuit(c, device_), as_reference ? basis_of_one() : Basis::kDeclared);
  const MatcherStore store = matcher_store(config_, width_, height_);
  const auto record_bits = [](const StoreLayout& layout) {
    constexpr std::int64_t kByteBits = 8;
    std::uint64_t bytes = 0;
    for (const StoreLayout::Pass& pass : layout.passes) bytes = std::max(bytes, pass.record_bytes);
    return kByteBits * static_cast<std::int64_t>(bytes);
  };
  if (store.keeps_rows()) {
    for (const char* way : {"pack_rows", "unpack_rows"})
      add_burst_stage(way, config_.dma.buffer, record_bits(store.rows));
  }
  if (store.keeps_frame()) {
    for (const char* way : {"pack_frame", "unpack_frame"})
      add_burst_stage(way, config_.dma.buffer, record_bits(store.frame));
  }
  // Of each of the rows at once.
  const auto costs = [&](const StageTiming& timing) {
    StageCircuit stage = circuit(timing);
    stage.at_once = m.parallel_rows;
    return CostCircuit{stage, m.parallelism, m.iterations, c.sum_bits};
  };
  add_stage("subpixel", subpixel_circuit(costs(config_.timing.subpixel), device_), basis_of_one());
  if (config_.uniqueness.enabled) {
    add_stage("uniqueness", uniqueness_circuit(costs(config_.timing.uniqueness), device_),
              config_.uniqueness.neighbours_are_rivals ? Basis::kDeclared : basis_of_one());
  }
  if (!config_.consistency.enabled) return;
  const Consistency kernel(config_.consistency, m.range(), width_, height_);
  add_stage("consistency",
            consistency_circuit(costs(config_.timing.consistency), kernel.look_ahead_pixels(), device_),
            Basis::kDeclared);
}

void Estimator::add_filters() {
  const int at_once = config_.timing.pixels_per_token;
  if (config_.texture.enabled)
    add_stage("texture", texture_circuit(circuit(config_.timing.texture), config_.texture, device_),
              Basis::kDeclared);
  for (const auto& filter : config_.filters.all()) {
    if (!filter->enabled(config_)) continue;
    const std::string& name = filter->name();
    const NoiseReductionConfig& noise = config_.noise_reduction;
    if (name == "speckle") {
      add_stage(name, speckle_circuit(circuit(config_.timing.speckle), config_.speckle, device_),
                Basis::kDeclared);
    } else if (name == "gap_interpolation") {
      add_stage(name,
                gap_interpolation_circuit(circuit(config_.timing.gap_interpolation),
                                          config_.gap_interpolation, device_),
                Basis::kDeclared);
    } else if (name == "noise_reduction" && noise.kind == NoiseReductionKind::kMean) {
      add_stage(name, mean_circuit({circuit(config_.timing.noise_reduction), noise.window}, device_),
                basis_of_one());
    } else if (name == "noise_reduction" && noise.kind == NoiseReductionKind::kMedian3x3) {
      add_stage(name, median_circuit(circuit(config_.timing.noise_reduction), device_), basis_of_one());
    } else {
      const FilterNeeds needs = filter->needs(config_, width_, height_, at_once);
      StageTiming timing;
      timing.latency = needs.latency;
      add_stage(name, stored_bits_circuit(name, circuit(timing), needs.storage.count(), device_),
                Basis::kDeclared);
    }
  }
  add_burst_stage("output_packing", config_.dma.output,
                  at_once * (gray_format().width() + disparity_format().width()).count());
}

void Estimator::add_streams() {
  for (const PlannedStream& stream : plan_streams(config_, width_, height_)) {
    if (!rectifies() && stream.name.rfind("map_", 0) == 0) continue;
    const FifoOffsets delays = config_.streams.offsets(stream.name);
    const FifoCircuit fifo{config_.streams.kind(stream.name), stream.depth, stream.bits, delays.write_to_read,
                           delays.read_to_write};
    const bool calibrated =
        device_.calibrated && fifo.kind != FifoKind::kAsynchronous && fifo.kind != FifoKind::kFree;
    result_.parts.push_back({Kind::kFifo, stream.name, "",
                             fmt::format("{} x {} bit, {}", stream.depth, stream.bits, name_of(fifo.kind)),
                             fifo, fifo_circuit(fifo, device_).all(), calibrated});
  }
}

void Estimator::add_engines() {
  const DmaConfig& dma = config_.dma;
  const auto add = [this](const std::string& name, const DmaPortConfig& port) {
    result_.parts.push_back({Kind::kEngine, name, "", "", {}, engine_circuit(port, device_).all(), false});
  };
  add("camera_left", dma.camera);
  add("camera_right", dma.camera);
  add("left", dma.left);
  add("right", dma.right);
  if (rectifies()) add("map", dma.map);
  add("output", dma.output);
  if (config_.link.enabled) add("link", dma.link);
  const MatcherStore store = matcher_store(config_, width_, height_);
  if (store.keeps_rows()) {
    add("buffer_row_write", dma.buffer);
    add("buffer_row_read", dma.buffer);
  }
  if (store.keeps_frame()) {
    add("buffer_frame_write", dma.buffer);
    add("buffer_frame_read", dma.buffer);
  }
}

}  // namespace

ResourceEstimate estimate(const MachineConfig& config, const DeviceFile& device, const EstimateSize& size) {
  const auto padded = [](int length, int granularity) {
    return (length + granularity - 1) / granularity * granularity;
  };
  const Granularity whole = config.image.granularity();
  const int image_width = size.width > 0 ? size.width : static_cast<int>(config.image.width);
  const int image_height = size.height > 0 ? size.height : static_cast<int>(config.image.height);
  int width = static_cast<int>(config.tiles.limit);
  if (image_width > 0) {
    width = plan_tiles(config.tiles, config.matching.range(), padded(image_width, whole.width),
                       config.timing.pixels_per_token)
                .width;
  }
  const int height =
      image_height > 0 ? padded(image_height, whole.height) : static_cast<int>(config.image.max_height);
  return Estimator(config, device, width, height).made();
}

}  // namespace parallax
