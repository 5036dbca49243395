// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/stage_values.hpp"

#include <utility>

#include "platform/cosim/vector_capture.hpp"

namespace parallax {
namespace {

// Stands in the slots around the stage, and does nothing.
class Nothing final : public sc_core::sc_module, public CircuitEnds {
 public:
  explicit Nothing(const sc_core::sc_module_name& name) : sc_module(name) {}
  void add(std::unique_ptr<CircuitEnd> end) override {
    end->ignore();
    ends_.push_back(std::move(end));
  }

 private:
  std::vector<std::unique_ptr<CircuitEnd>> ends_;
};

SlotModule nothing(const std::string& name, const StageContext&) {
  SlotModule slot;
  slot.module = std::make_unique<Nothing>(name.c_str());
  slot.takes_tokens = true;
  return slot;
}

std::uint64_t pass_tokens(const TokenShape& shape, int height) {
  if (shape.runs.empty()) return shape.row_tokens * static_cast<std::uint64_t>(height);
  std::uint64_t tokens = 0;
  for (const TapConfig::Run& run : shape.runs) tokens += run.tokens;
  return tokens;
}

}  // namespace

StageValues::StageValues(const MachineConfig& config, int width, int height, const EncodedMap& map,
                         const std::string& stage, const char* option)
    : tiles_(plan_tiles(config.tiles, config.matching.range(), width, config.timing.pixels_per_token)),
      tiled_map_(tiles_.tiles.size() > 1 ? cut_map(map, tiles_) : EncodedMap{}),
      clock_("core", Hertz(config.clocks.core_hz)),
      dataflow_("dataflow") {
  const StageContext context{
      clock_, dataflow_, tiles_.width, height, config.timing.overlap_frames, config.timing.pixels_per_token};
  pipeline_ =
      std::make_unique<Pipeline>("pipeline", config, tiles_.tiles.size() > 1 ? tiled_map_ : map, tiles_,
                                 context, StageReplacements{{stage, nullptr}, {kAllOtherSlots, nothing}});
  check_vectors(*pipeline_, config, stage, option);
  for (const TokenPort& port : pipeline_->ports(stage)) {
    ports_.push_back(
        {port.name, port.streams.front(), port.is_input, port.shape, pass_tokens(port.shape, height)});
    ends_.push_back(port.opposite());
  }
  // Ports are bound to their streams when the simulation begins, which it does and no more.
  sc_core::sc_report_handler::set_actions(sc_core::SC_ID_NO_SC_START_ACTIVITY_, sc_core::SC_DO_NOTHING);
  sc_core::sc_start(sc_core::SC_ZERO_TIME);
}

StageValues::~StageValues() = default;

void StageValues::push(std::size_t port, const std::vector<std::uint64_t>& bits) { ends_[port]->send(bits); }

bool StageValues::pop(std::size_t port, std::vector<std::uint64_t>& bits) {
  if (!ends_[port]->front(bits)) return false;
  ends_[port]->pop(false);
  return true;
}

}  // namespace parallax
