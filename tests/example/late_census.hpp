// SPDX-License-Identifier: Apache-2.0
// The census stage once more: as a stage of one's own that takes longer, and as a block in kernel time.
#pragma once

#include <deque>
#include <systemc>
#include <vector>

#include "modules/census.hpp"
#include "modules/raster_schedule.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// The same codes out of a deeper pipeline.
class LateCensus final : public Stage {
 public:
  StreamIn<Gray> in_left{"in_left"};
  StreamIn<Gray> in_right{"in_right"};
  StreamOut<CensusCode> out_left{"out_left"};
  StreamOut<CensusCode> out_right{"out_right"};

  LateCensus(const sc_core::sc_module_name& name, const CensusConfig& config, std::uint32_t latency,
             const StageContext& context)
      : Stage(name, context.clock, context.dataflow, latency),
        left_(config, context.width, context.height),
        right_(config, context.width, context.height),
        look_ahead_(look_ahead_tokens(context, left_.look_ahead_rows(), left_.look_ahead_pixels())) {
    RasterSchedule raster;
    raster.reads.every = raster.writes.every = 0b11;
    raster.look_ahead = look_ahead_;
    set_schedule(make_schedule(context, raster));
    const auto width = static_cast<std::size_t>(context.width);
    in_left.on_row(width, [this, width](const Gray* row, std::size_t) {
      left_.push(row, [this, width](const CensusCode* out) { out_left.send_row(out, width); });
    });
    in_right.on_row(width, [this, width](const Gray* row, std::size_t) {
      right_.push(row, [this, width](const CensusCode* out) { out_right.send_row(out, width); });
    });
  }

  std::uint64_t look_ahead() const { return look_ahead_; }

 private:
  Census left_;
  Census right_;
  std::uint64_t look_ahead_;
};

/// The same codes from a thread, as an RTL model would be clocked by one. It works by rows, and so looks a
/// row further ahead than the window.
class ClockedCensus final : public sc_core::sc_module {
 public:
  StreamIn<Gray> in_left{"in_left"};
  StreamIn<Gray> in_right{"in_right"};
  StreamOut<CensusCode> out_left{"out_left"};
  StreamOut<CensusCode> out_right{"out_right"};

  ClockedCensus(const sc_core::sc_module_name& name, const CensusConfig& config, const StageContext& context)
      : sc_module(name),
        clock_(context.clock),
        width_(static_cast<std::size_t>(context.width)),
        left_(config, context.width, context.height),
        right_(config, context.width, context.height),
        frame_(context.tokens()),
        look_ahead_(width_ * static_cast<std::size_t>(left_.look_ahead_rows() + 1)) {
    SC_HAS_PROCESS(ClockedCensus);
    SC_THREAD(run);
  }

  std::uint64_t look_ahead() const { return look_ahead_; }

 private:
  void run() {
    for (;;) {
      for (std::uint64_t pixel = 0; pixel < frame_ + look_ahead_; ++pixel) {
        if (pixel < frame_) read();
        if (pixel >= look_ahead_) write();
        clock_.wait_until(clock_.now() + Cycles(1));
      }
    }
  }
  void read() {
    left_row_.push_back(in_left->read());
    right_row_.push_back(in_right->read());
    if (left_row_.size() < width_) return;
    const auto keep = [this](std::deque<CensusCode>& codes) {
      return [this, &codes](const CensusCode* row) { codes.insert(codes.end(), row, row + width_); };
    };
    left_.push(left_row_.data(), keep(left_codes_));
    right_.push(right_row_.data(), keep(right_codes_));
    left_row_.clear();
    right_row_.clear();
  }
  void write() {
    out_left->write(left_codes_.front());
    out_right->write(right_codes_.front());
    left_codes_.pop_front();
    right_codes_.pop_front();
  }

  const ClockDomain& clock_;
  const std::size_t width_;
  Census left_;
  Census right_;
  const std::uint64_t frame_;  // pixels
  const std::uint64_t look_ahead_;
  std::vector<Gray> left_row_, right_row_;
  std::deque<CensusCode> left_codes_, right_codes_;
};

}  // namespace parallax
