// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <systemc>
#include <vector>

#include "platform/config/machine_config.hpp"
#include "platform/machine/busy_time.hpp"
#include "platform/machine/machine_input.hpp"
#include "platform/machine/memory_map.hpp"
#include "platform/machine/part.hpp"
#include "platform/registers/core_driver.hpp"

namespace parallax {

/// The device's software: hands frames from one side of the memory to the next. When a frame is in memory,
/// the core may take one (it is idle, or frames queue in it: software.queue_frames) and a buffer for the
/// results is free, it starts the core, software.response_ns later, through the core's registers; if the core
/// refuses, it tries again after as long a time, 1 us at least. What the core has written it hands to the
/// link; the buffer is free when the host has it.
class Software final : public sc_core::sc_module {
 public:
  /// Sends the results of `frame`, which lie at `address`; all of them are in memory, or as many as
  /// link.early_start_rows says.
  using Send = std::function<void(std::int64_t frame, std::uint64_t address)>;

  /// `config`, `input` and `memory_map` must outlive the object.
  Software(const sc_core::sc_module_name& name, const MachineConfig& config, const MachineInput& input,
           const MemoryMap& memory_map, const CoreFacts& core, Send send);

  /// To the core's registers.
  CoreDriver driver{"driver"};

  /// One more frame is in memory, as far as the core waits for it.
  void frame_startable();
  /// Whether it writes the registers of a frame just now: at other times no start is expected.
  bool offers() const { return offers_; }
  /// The core takes the frame, within the write to its control register.
  void core_started();
  /// So much of the frame's results is in memory as a link waits for that sends early.
  void results_begun(std::int64_t frame) { send(frame); }
  /// The core has ended the frame: all of its results are in memory.
  void core_ended(std::int64_t frame);
  /// The host has a frame: its buffer is free.
  void output_buffer_free();

  /// Starts that the core has refused (an initiator has switched it off, say).
  std::int64_t rejected_starts() const { return rejected_starts_; }
  /// Time until now in which it was about to start the core; in which the core worked or was about to be
  /// started; and in which only a buffer for its results kept the core from a frame.
  sc_core::sc_time starting_time() const { return starting_time_.until_now(); }
  sc_core::sc_time core_time() const { return core_time_.until_now(); }
  sc_core::sc_time output_full_time() const { return output_full_time_.until_now(); }
  /// Itself, unless it takes no time.
  std::vector<Part> parts() const;

 private:
  void start_when_possible();
  void start_core();
  void send(std::int64_t frame);

  const MachineConfig& config_;
  const MachineInput& input_;
  const MemoryMap& memory_map_;
  const CoreFacts core_;
  const Send send_;
  sc_core::sc_event start_;
  std::int64_t startable_ = 0;            // frames
  std::int64_t started_ = 0;              // of them, in the core or through it
  std::int64_t in_core_ = 0;              // of them
  std::int64_t sent_ = 0;                 // of them, or on their way to the host
  std::int64_t output_buffers_used_ = 0;  // from before the start until the host has the results
  bool starting_ = false;                 // it is about to start the next frame
  bool offers_ = false;
  bool parameters_written_ = false;  // once, before the first frame
  std::int64_t asked_ = 0;           // frames whose parameters the run has been asked for
  std::int64_t rejected_starts_ = 0;
  BusyTime starting_time_;
  BusyTime core_time_;
  BusyTime output_full_time_;
};

}  // namespace parallax
