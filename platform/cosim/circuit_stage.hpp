// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <systemc>
#include <vector>

#include "modules/raster_schedule.hpp"
#include "platform/cosim/circuit_library.hpp"
#include "platform/cosim/circuit_pins.hpp"
#include "platform/cosim/circuit_port.hpp"
#include "platform/cosim/circuit_watch.hpp"
#include "platform/cosim/circuit_waves.hpp"
#include "platform/cosim/ready_probe.hpp"
#include "platform/cosim/result_delay.hpp"
#include "platform/cosim/stage_record.hpp"
#include "platform/input/circuit_options.hpp"
#include "platform/machine/circuit_end.hpp"
#include "tlm/dataflow.hpp"

namespace parallax {

/// A circuit in the place of a stage, clocked cycle by cycle of the core's clock.
///
/// In cycle c an input's valid is 1 when the stream's next token can be read then, an output's ready when the
/// stream has room; a token passes where both are 1, and that is the date of its reading or writing. So the
/// circuit meets the FIFOs of the machine and nothing else: no register, no place, no cycle is added. Reset
/// lies before cycle 0.
///
/// A handshake follows from the pins that there are. An output without ready cannot wait, nor can an input
/// without valid: where there is no room, or no token, the clock stands still (the enable pin is 0, or, if
/// there is none, there is no edge). Without valid at an output, its tokens are those that leave
/// `CircuitOptions::latency` edges behind the token at the inputs.
///
/// Behind a row or a frame there may be a gap, in which the clock runs though there is no token, as in
/// blanking. A circuit with line_valid (frame_valid) and without valid has its clock running between rows
/// (frames) anyway.
///
/// When nothing has been due for a thousand cycles, as between frames, the clock stands until the next token.
///
/// It goes ahead of the kernel's time as long as the dates that it needs are known. Where one is not, the
/// kernel's time comes to the cycle first, and the token is not there, or there is no room. Of several
/// circuits, one upstream does what it does in a cycle before those downstream.
class CircuitStage final : public sc_core::sc_module, public Actor, public CircuitEnds {
 public:
  /// At most so many in one machine.
  static constexpr std::size_t kMost = 64;

  /// `model`: what the model's stage did, with values of the frames that have images. `order`: of circuits in
  /// one machine, upstream first, from 0. `stop` is called once, when it cannot go on: fault() says why. All
  /// must outlive it.
  CircuitStage(const sc_core::sc_module_name& name, Circuit& circuit, const CircuitPins& pins,
               const StageRecord& model, const CircuitOptions& options, std::size_t order,
               const StageContext& context, std::function<void()> stop);
  ~CircuitStage() override;

  void add(std::unique_ptr<CircuitEnd> end) override;
  void advance() override;

  /// Output `index` of the model's stage.
  const CircuitOutput& output(std::size_t index) const { return *outputs_.at(index); }
  /// Why the circuit was given up: it hangs, or has ended the simulation; empty: it was not.
  const std::string& fault() const { return fault_; }
  /// The first breach of the handshake; empty: none.
  const std::string& breach() const;
  /// The first start of frame or end of line, beside an output, that is not in its place; empty: none.
  const std::string& framing_breach() const;
  /// What is no breach and yet worth a line.
  std::vector<std::string> notes() const;
  std::uint64_t cycles() const { return clocked_; }  ///< in which it was clocked

  /// Before the simulation: keeps what the pins do in so many cycles before and behind the first difference.
  void keep_waves(std::uint64_t cycles);
  /// None if nothing happened that is worth them.
  std::optional<PinWaves> waves() const;

 private:
  void end_of_elaboration() override;
  void start_of_simulation() override;
  void resolve();
  void go_on();
  bool wakes();
  bool all_known() const;
  void wait_for_dates();
  void step();
  bool can_run() const;
  bool goes_without_token() const;
  bool has_room() const;
  bool lacks_token(const CircuitInput& input) const;
  bool is_behind(const CircuitOutput& output) const;
  static bool lacks_room(const CircuitOutput& output);
  void edge();
  void set_clock(bool high);
  void look_for_first();
  void give_up(const std::string& why);
  std::string waits() const;
  std::string what_stops_clock() const;
  std::uint64_t begun() const;
  bool owes() const;

  Circuit& circuit_;
  const CircuitPins& pins_;
  const std::string where_;
  const CircuitOptions& options_;
  const Dataflow& dataflow_;
  const ClockDomain& clock_;
  const std::function<void()> stop_;
  const sc_core::sc_time after_edge_;  // where the kernel's time has come this far, the edge's turn is here

  std::uint64_t timeout_ = 0;  // cycles

  std::vector<std::unique_ptr<CircuitEnd>> ends_;
  std::vector<std::unique_ptr<CircuitInput>> inputs_;
  std::vector<std::unique_ptr<CircuitOutput>> outputs_;
  std::vector<std::vector<CircuitInput*>> joined_inputs_;  // all inputs, those that pass together in a group
  std::vector<std::vector<CircuitOutput*>> joined_outputs_;
  std::vector<ReadyProbe> probes_;  // of each of these, where sides are stalled
  ResultDelay delay_;               // of a circuit without valid at its outputs
  std::uint64_t paced_ = 0;         // cycles in which its clock did not stand for want of room
  bool needs_all_ = false;          // an output has no valid: there is a step only with a token at each input
  Cycles cycle_{0};                 // the next one
  Cycles moved_{0};                 // the last one in which a token passed,
  Cycles idle_{0};                  // from which on the clock runs again after a rest,
  Cycles due_{0};                   // and in which a token was offered first
  bool rests_ = false;
  std::uint64_t clocked_ = 0;
  sc_core::sc_time known_until_;  // every date before this is known
  sc_core::sc_event timer_;
  bool timer_runs_ = false;
  std::unique_ptr<CircuitWatch> watch_;  // from the simulation's start on
  std::string fault_;
  std::unique_ptr<CircuitWaves> waves_;  // if wanted
};

}  // namespace parallax
