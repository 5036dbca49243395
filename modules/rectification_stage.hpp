// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <systemc>
#include <vector>

#include "modules/raster_schedule.hpp"
#include "modules/rectification.hpp"
#include "modules/row_join.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// Rectification of both images: pixel pairs in, half a window of rows ahead of the map entry and the pixel
/// pair that comes out (rectification.hpp; paper, "Rectification").
class RectificationStage final : public Stage {
 public:
  StreamIn<Gray> in_left{"in_left"};
  StreamIn<Gray> in_right{"in_right"};
  StreamIn<OffsetPair> in_map{"in_map"};
  StreamOut<Gray> out_left{"out_left"};
  StreamOut<Gray> out_right{"out_right"};

  RectificationStage(const sc_core::sc_module_name& name, const RectificationConfig& config,
                     const StageTiming& timing, const StageContext& context);

  std::uint64_t look_ahead() const { return look_ahead_; }
  Bits storage() const { return Bits(kernel_.storage_bits()); }

 private:
  void push_waiting_images();

  Rectification kernel_;
  Rectification::Emit emit_;
  RowJoin<Gray, Gray> images_;
  std::deque<std::vector<Gray>> waiting_;  // left and right rows in turn that the window has no room for yet
  std::uint64_t look_ahead_;
};

}  // namespace parallax
