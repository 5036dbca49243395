// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <systemc>
#include <unordered_map>
#include <vector>

#include "tlm/dataflow.hpp"
#include "traces/fifo_trace.hpp"
#include "traces/port_trace.hpp"
#include "traces/sampling_timer.hpp"
#include "traces/stage_trace.hpp"
#include "traces/token_trace.hpp"
#include "traces/trace_window.hpp"

namespace parallax {

/// What a recorder tells of.
struct RecorderConfig {
  TraceWindow window{};
  bool tokens = false;      ///< every firing, token and burst, not rows alone
  std::int32_t rows = 0;    ///< of the image
  std::int32_t tiles = 1;   ///< that a frame is processed in
  std::int64_t frames = 0;  ///< of the run
  sc_core::sc_time period;  ///< how often FIFOs are looked at; sinks are notified as often, or less
};

/// Listens to the parts that it is given and notifies sinks of what they do. A part that it is not given
/// costs nothing. Dates are known ahead of kernel time, part by part, and sinks get them so: each part's in
/// their order, save that answers of a memory may come in another than they are known in.
///
/// Parts are added when all ports are bound, sinks before; they must outlive the simulation.
class Recorder final : public sc_core::sc_module {
 public:
  /// `add_parts` is called when all ports are bound, before the simulation starts.
  Recorder(const sc_core::sc_module_name& name, const RecorderConfig& config, Dataflow& dataflow,
           SamplingTimer& timer, std::function<void()> add_parts);

  /// `rows`: of the tokens; none when they belong to no row.
  void add(StreamBase& stream, const std::shared_ptr<const RowEnds>& rows);
  void add(Stage& stage, const StagePorts& ports);
  void add(BusMaster& master, const std::string& name, const std::shared_ptr<const RowEnds>& rows);
  /// One that wants the order of the dates takes a DateOrder before it.
  void add(TraceSink& sink) { sinks_.push_back(&sink); }

  /// A frame has come to a step, now.
  void frame_step(std::int64_t frame, FrameStep step);
  /// A frame is at the host.
  void frame(const FrameRecord& record);
  /// The simulation is over: tells what is left. `waits`: of a machine that is stuck.
  void finish(const std::vector<EndlessWait>& waits = {});

 private:
  static constexpr std::uint64_t kLooksBetween = 8;

  void start_of_simulation() override;
  void go_on();
  void tell_until(Picoseconds date);
  PartId id_of(const StreamBase* stream) const;

  const RecorderConfig config_;
  Dataflow& dataflow_;
  const std::function<void()> add_parts_;
  TraceParts parts_;
  TraceSinks sinks_;
  std::vector<const StreamBase*> streams_;
  std::unordered_map<const StreamBase*, PartId> stream_ids_;
  std::deque<FifoTrace> fifos_;
  std::deque<TokenTrace> tokens_;
  std::deque<StageTrace> stages_;
  std::deque<PortTrace> ports_;
  std::uint64_t looks_ = 0;
};

}  // namespace parallax
