// SPDX-License-Identifier: Apache-2.0
#include "platform/estimate/pipeline_plan.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "modules/token_formats.hpp"
#include "platform/machine/matcher_store.hpp"
#include "tlm/fork_depths.hpp"

namespace parallax {
namespace {

struct Ahead {
  int rows = 0;
  int pixels = 0;
};

template <class Kernel>
Ahead ahead_of(const Kernel& kernel) {
  return {kernel.look_ahead_rows(), kernel.look_ahead_pixels()};
}

// The graph of stages and streams, as it is written down.
class Plan {
 public:
  Plan(const MachineConfig& config, int width, int height)
      : config_(config), width_(width), height_(height) {}

  void stage(const std::string& name, const Ahead& ahead = {}, std::uint64_t latency = 0,
             std::uint64_t group = 0) {
    index_[name] = graph_.nodes.size();
    graph_.nodes.push_back({look_ahead(ahead), latency, group});
  }
  enum class Reads { kAhead, kLate, kGroups };
  void stream(const std::string& name, std::int64_t bits, const std::string& from, const std::string& to,
              Reads reads = Reads::kAhead) {
    streams_.push_back({name, 0, bits});
    graph_.edges.push_back({index_.at(from), index_.at(to), config_.streams.offsets(name),
                            reads == Reads::kGroups, reads == Reads::kLate});
  }
  /// From the memory back to the matcher, where no fork leads to.
  void returned_stream(const std::string& name, std::int64_t bits) { returned_.push_back({name, 0, bits}); }

  std::vector<PlannedStream> made() {
    const std::vector<std::uint64_t> needed = fork_depths(graph_);
    for (std::size_t i = 0; i < streams_.size(); ++i)
      streams_[i].depth = config_.streams.resolve(streams_[i].name, static_cast<std::uint32_t>(needed[i]));
    for (PlannedStream& stream : returned_) {
      stream.depth = config_.streams.resolve(stream.name, 0);
      streams_.push_back(stream);
    }
    return std::move(streams_);
  }

 private:
  // In tokens, as look_ahead_tokens() has it.
  std::uint64_t look_ahead(const Ahead& ahead) const {
    const int pixels = config_.timing.pixels_per_token;
    const std::uint64_t row = width_ / pixels;
    const std::uint64_t in_row = (ahead.pixels + pixels - 1) / pixels;
    return std::min(ahead.rows * row + in_row, row * height_);
  }

  const MachineConfig& config_;
  const int width_;
  const int height_;
  std::map<std::string, std::size_t> index_;
  ForkGraph graph_;
  std::vector<PlannedStream> streams_;
  std::vector<PlannedStream> returned_;
};

void place_stages(const MachineConfig& config, int width, int height, Plan& plan) {
  const PipelineTiming& time = config.timing;
  const DisparityRange range = config.matching.range();
  const CostGroups groups = config.matching.groups(time.pixels_per_token);
  const int reach = config.rectification.range.reach();
  for (const char* name : {"unpack_left", "unpack_right", "unpack_map"}) plan.stage(name);
  plan.stage("map_decoder", {}, time.map_decoder.latency);
  plan.stage("rectification", {reach, reach}, time.rectification.latency);
  plan.stage("census", ahead_of(Census(config.census, width, height)), time.census.latency);
  plan.stage("matching", ahead_of(Matching(config.matching, width, height, config.census.code_bits())),
             time.matching.latency, groups.of_token);
  plan.stage("subpixel", {}, time.subpixel.latency, groups.of_token);
  // Of parallel rows, each pixel is a column of them.
  const auto checks = [&](const auto& kernel) {
    return Ahead{kernel.look_ahead_rows(), groups.rows * kernel.look_ahead_pixels()};
  };
  plan.stage("uniqueness", checks(Uniqueness(config.uniqueness, range, width, height)),
             time.uniqueness.latency, groups.of_token);
  plan.stage("consistency", checks(Consistency(config.consistency, range, width, height)),
             time.consistency.latency, groups.of_token);
  plan.stage("texture", ahead_of(Texture(config.texture, width, height)), time.texture.latency);
  for (const auto& filter : config.filters.all()) {
    const FilterNeeds needs = filter->needs(config, width, height, time.pixels_per_token);
    plan.stage(filter->name(), {needs.look_ahead_rows, needs.look_ahead_pixels}, needs.latency);
  }
  plan.stage("output_packing");
}

void connect_inputs(const MachineConfig& config, Plan& plan) {
  const std::int64_t pixels = config.timing.pixels_per_token;
  const std::int64_t grey = pixels * gray_format().width().count();
  const std::int64_t offsets =
      pixels * offset_pair_format(config.rectification.range.offset_bits()).width().count();
  plan.stream("left_pixels", grey, "unpack_left", "rectification");
  plan.stream("right_pixels", grey, "unpack_right", "rectification");
  plan.stream("map_words", config.dma.map.data_bits, "unpack_map", "map_decoder");
  plan.stream("map_entries", offsets, "map_decoder", "rectification", Plan::Reads::kLate);
  plan.stream("left_rectified", grey, "rectification", "census");
  plan.stream("right_rectified", grey, "rectification", "census");
  plan.stream("left_texture", grey, "rectification", "texture");
  plan.stream("left_output", grey, "rectification", "output_packing");
}

void connect_matching(const MachineConfig& config, Plan& plan) {
  const std::int64_t pixels = config.timing.pixels_per_token;
  const int code_bits = config.census.code_bits();
  const std::int64_t disparity = pixels * disparity_format().width().count();
  const std::int64_t costs = std::int64_t{config.matching.parallel_rows} * config.matching.parallelism *
                             summed_cost_bits(config.matching, code_bits);
  plan.stream("left_codes", pixels * code_bits, "census", "matching");
  plan.stream("right_codes", pixels * code_bits, "census", "matching");
  for (const char* stage : {"subpixel", "uniqueness", "consistency"})
    plan.stream(std::string("costs_") + stage, costs, "matching", stage, Plan::Reads::kGroups);
  plan.stream("winners", disparity, "subpixel", "uniqueness");
  plan.stream("unique", disparity, "uniqueness", "consistency");
  plan.stream("consistent", disparity, "consistency", "texture", Plan::Reads::kLate);
  std::string from = "texture";
  std::string stream = "textured";
  for (const auto& filter : config.filters.all()) {
    plan.stream(stream, disparity, from, filter->name());
    from = filter->name();
    stream = filter->stream();
  }
  plan.stream(stream, disparity, from, "output_packing");
}

void connect_store(const std::string& what, const StoreLayout& layout, Plan& plan) {
  constexpr std::int64_t kByteBits = 8;
  std::uint64_t record = 0;
  for (const StoreLayout::Pass& pass : layout.passes) record = std::max(record, pass.record_bytes);
  const auto bits = kByteBits * static_cast<std::int64_t>(record);
  plan.stage("pack_" + what);
  plan.stream("kept_" + what, bits, "matching", "pack_" + what);
  plan.returned_stream("returned_" + what, bits);
}

}  // namespace

std::vector<PlannedStream> plan_streams(const MachineConfig& config, int width, int height) {
  Plan plan(config, width, height);
  place_stages(config, width, height, plan);
  connect_inputs(config, plan);
  connect_matching(config, plan);
  const MatcherStore store = matcher_store(config, width, height);
  if (store.keeps_rows()) connect_store("rows", store.rows, plan);
  if (store.keeps_frame()) connect_store("frame", store.frame, plan);
  return plan.made();
}

}  // namespace parallax
