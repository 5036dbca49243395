// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <systemc>
#include <tlm>

#include "modules/map_codec.hpp"
#include "platform/machine/frame.hpp"
#include "platform/machine/stage_slot.hpp"
#include "platform/registers/algorithm_parameters.hpp"
#include "traces/trace_event.hpp"

namespace parallax {

class Machine;

/// What a run of the machine is made of, apart from its configuration.
struct MachineInput {
  int width = 0;   ///< px, of the images as they are processed
  int height = 0;  ///< px
  const EncodedMap* map = nullptr;
  std::int64_t frames = 1;        ///< of the run
  std::int64_t least_frames = 0;  ///< after so many it may end when it is steady; 0: after `frames`
  /// Asked, if there is one, with each frame from then on, whether more would show nothing new; if there is
  /// none, they are enough when Machine::settled().
  std::function<bool(const Machine& machine)> enough;
  StageReplacements replacements;  ///< what stands in the place of stages of the pipeline
  bool timing_only = false;        ///< no frame has images, so the memory need not hold any
  /// Called, if there is one, with the socket of each memory port, to bind it: another memory in the place of
  /// the machine's own. A TLM-2.0 target that keeps to the base protocol and answers transport_dbg; it must
  /// hold data unless `timing_only`.
  std::function<void(::tlm::tlm_initiator_socket<>& socket, const std::string& port)> bind_memory;
  /// Cycles of the core's clock in which nothing may move, no frame being due at a date to come: then
  /// SC_REPORT_ERROR /parallax/machine/hang says who holds the machine up. 0: never. None: where there is
  /// another memory, or a block in kernel time in the place of a stage, at least a million and four times
  /// what the slowest part takes for a frame; else never, as then the simulation ends by itself when the
  /// machine is stuck, unless other modules keep its time going.
  std::optional<std::uint64_t> hang_cycles;
  /// Called, if there is one, once a frame, in order, before software starts the core with it: what software
  /// writes into the registers of algorithm parameters then, or nothing. What is impossible sets error bits,
  /// and the frame is processed with the last possible parameters.
  std::function<std::optional<AlgorithmParameters>(std::int64_t frame)> parameters;
  /// Called, if there is one, once a frame, in order, when it is exposed. The cameras go on after the last
  /// one, without images, as long as the simulation runs, so that every frame meets the traffic of its
  /// successors.
  std::function<StereoFrame(std::int64_t frame)> expose;
  /// Called, if there is one, when a frame comes to a step, at that date: exposed, first byte in memory, in
  /// memory, core started, results in memory, at the host. Of the frames after the last one, too.
  std::function<void(std::int64_t frame, FrameStep step)> step;
  /// Called once, when the host has the last frame; if there is none, the simulation is stopped then
  /// (sc_stop).
  std::function<void()> finished;
  /// Called, if there is one, once a frame, in order, when the host has it; not for what follows the last
  /// one.
  std::function<void(const FrameResult& result)> deliver;

  /// Puts what `make` makes in the place of the stage of that name (as in reports: "census"), as bind_memory
  /// puts a memory in the place of the machine's own. Throws UserError when it is bound already, or when
  /// there is nothing that makes it; that the pipeline has no such stage is found when the machine is made.
  void bind_stage(const std::string& name, StageFactory make);
};

}  // namespace parallax
