// SPDX-License-Identifier: Apache-2.0
// What a user's block in the place of the census stage may get wrong: tokens and values that are lost, or too
// many.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

#include "modules/pixel.hpp"
#include "modules/raster_schedule.hpp"
#include "platform/machine/stage_slot.hpp"
#include "tlm/stage.hpp"

namespace parallax::test {

/// What goes wrong at the left output, in one frame.
struct CensusFault {
  std::int64_t frame = -1;  ///< -1: nothing
  std::uint64_t token = 0;  ///< of the frame
  bool twice = false;       ///< it is written twice; else it is lost
};

/// Hands grey values on as codes, a stage with a schedule of its own.
class FaultyCensusStage final : public Stage {
 public:
  StreamIn<Gray> in_left{"in_left"};
  StreamIn<Gray> in_right{"in_right"};
  StreamOut<CensusCode> out_left{"out_left"};
  StreamOut<CensusCode> out_right{"out_right"};

  /// The schedule reads `read` and writes `written` tokens of a frame; the values are right but for `fault`,
  /// and for one that comes, if it is `early`, before there is any grey value.
  FaultyCensusStage(const sc_core::sc_module_name& name, const StageContext& context, std::uint64_t read,
                    std::uint64_t written, CensusFault fault, bool early = false)
      : Stage(name, context.clock, context.dataflow, 2), frame_(context.tokens()), fault_(fault) {
    const std::uint64_t both = std::min(read, written);
    set_schedule(Schedule()
                     .run(fires(both).reads(0b11).writes(0b11))
                     .run(fires(read - both).reads(0b11))
                     .run(fires(written - both).writes(0b11)));
    in_left.on_row(0, [this](const Gray* row, std::size_t size) {
      std::vector<CensusCode> codes;
      for (std::size_t i = 0; i < size; ++i, ++taken_) {
        const bool wrong = taken_ == static_cast<std::uint64_t>(fault_.frame) * frame_ + fault_.token;
        const std::size_t times = fault_.frame < 0 || !wrong ? 1 : fault_.twice ? 2 : 0;
        codes.insert(codes.end(), times, row[i]);
      }
      out_left.send_row(codes.data(), codes.size());
    });
    in_right.on_row(0, [this](const Gray* row, std::size_t size) {
      const std::vector<CensusCode> codes(row, row + size);
      out_right.send_row(codes.data(), size);
    });
    if (!early) return;
    SC_HAS_PROCESS(FaultyCensusStage);
    SC_METHOD(send_one);
  }

 private:
  void send_one() {
    const CensusCode code = 0;
    out_left.send_row(&code, 1);
  }

  const std::uint64_t frame_;
  const CensusFault fault_;
  std::uint64_t taken_ = 0;
};

/// As FaultyCensusStage from a thread, a token a cycle; a token leaves it when `held` more have come, the
/// first of all, if it is `early`, before any has.
class FaultyCensusThread final : public sc_core::sc_module {
 public:
  StreamIn<Gray> in_left{"in_left"};
  StreamIn<Gray> in_right{"in_right"};
  StreamOut<CensusCode> out_left{"out_left"};
  StreamOut<CensusCode> out_right{"out_right"};

  FaultyCensusThread(const sc_core::sc_module_name& name, const StageContext& context, CensusFault fault,
                     std::size_t held, bool early)
      : sc_module(name),
        clock_(context.clock),
        frame_(context.tokens()),
        fault_(fault),
        held_(held),
        early_(early) {
    SC_HAS_PROCESS(FaultyCensusThread);
    SC_THREAD(run);
  }

 private:
  void run() {
    if (early_) {  // a date alone, as in frames without images
      out_left->wait_writable();
      out_left->commit();
    }
    for (std::int64_t frame = 0;; ++frame) {
      for (std::uint64_t token = 0; token < frame_; ++token) {
        left_.push_back(in_left->read());
        right_.push_back(in_right->read());
        while (left_.size() > held_) {
          const bool wrong = frame == fault_.frame && token == fault_.token;
          if (!wrong || fault_.twice) out_left->write(left_.front());
          if (wrong && fault_.twice) out_left->write(left_.front());
          out_right->write(right_.front());
          left_.pop_front();
          right_.pop_front();
        }
        clock_.wait_until(clock_.now() + Cycles(1));
      }
    }
  }

  const ClockDomain& clock_;
  const std::uint64_t frame_;
  const CensusFault fault_;
  const std::size_t held_;
  const bool early_;
  std::deque<CensusCode> left_, right_;
};

inline StageFactory faulty_stage(std::int64_t more_read, std::int64_t more_written, CensusFault fault) {
  return [=](const std::string& name, const StageContext& context) {
    const auto tokens = static_cast<std::int64_t>(context.tokens());
    return slot_module(std::make_unique<FaultyCensusStage>(name.c_str(), context, tokens + more_read,
                                                           tokens + more_written, fault));
  };
}

inline StageFactory faulty_thread(CensusFault fault, std::size_t held = 0, std::uint64_t latency = 0,
                                  bool early = false) {
  return [=](const std::string& name, const StageContext& context) {
    SlotModule slot;
    slot.module = std::make_unique<FaultyCensusThread>(name.c_str(), context, fault, held, early);
    slot.latency = latency;
    return slot;
  };
}

}  // namespace parallax::test
