// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <systemc>
#include <vector>

#include "platform/config/machine_config.hpp"
#include "platform/registers/algorithm_parameters.hpp"
#include "platform/registers/run_time_parameters.hpp"
#include "tlm/bus_master.hpp"
#include "tlm/register_bank.hpp"

namespace parallax {

/// What a start tells the core, as the registers say it at that moment.
struct FrameCommand {
  std::uint64_t left = 0;    ///< address
  std::uint64_t right = 0;   ///< address
  std::uint64_t map = 0;     ///< address
  std::uint64_t output = 0;  ///< address
  std::uint64_t buffer = 0;  ///< address; of no meaning to a matcher that keeps nothing in memory
  AlgorithmParameters parameters;
};

/// What the control blocks have to know of the core to judge a start and to report on it.
struct CoreFacts {
  int width = 0;                  ///< px
  int height = 0;                 ///< px
  std::uint64_t image_bytes = 0;  ///< of one image in memory
  std::uint64_t start_bytes = 0;  ///< of an image, that must be in memory for a start
  std::uint64_t map_bytes = 0;
  std::uint64_t output_bytes = 0;
  std::uint64_t buffer_bytes = 0;  ///< 0: the matcher keeps nothing in memory
  std::uint64_t memory_bytes = 0;
  struct Master {
    const BusMaster* master;
    std::uint32_t slots;  ///< requests that it may have under way
  };
  Master left, right, map, output;
  std::vector<Master> buffer;
};

/// The core's two control blocks (register_map.hpp). A start is judged as a whole: what cannot be, sets error
/// bits and has no other effect. Impossible algorithm parameters set error bits too, but the frame is
/// processed with the last possible ones.
class ControlBlocks final : public sc_core::sc_module {
 public:
  RegisterBank bank;

  struct Hooks {
    std::function<bool()> expected;  ///< whether software is about to start a frame; else it is refused
    std::function<void(const FrameCommand&)> on_start{};  ///< called within the write that starts it
  };

  /// `config` must outlive the object.
  ControlBlocks(const sc_core::sc_module_name& name, const MachineConfig& config, const CoreFacts& facts,
                Hooks hooks);

  /// The results of the oldest frame under way are in memory.
  void frame_done();
  /// A frame of the cameras was found to have a fault; nobody starts the core with it.
  void frame_faulty(CameraFault fault);

 private:
  using Field = RegisterBank::Field;
  struct Address {
    Field high, low;
  };
  struct ParameterField {
    const RunTimeParameter* parameter;
    Field field;
  };

  Field dma(const std::string& reg, const std::string& field) { return bank.field("dma", reg, field); }
  Field stereo(const std::string& reg, const std::string& field) { return bank.field("stereo", reg, field); }
  Address address_of(const std::string& data);
  void show_fifo_on_read(const std::string& reg, const std::vector<CoreFacts::Master>& ports);
  void start(std::uint32_t triggers);
  bool judge_start();
  bool in_memory(const Address& address, std::uint64_t bytes) const;
  /// What the registers of parameters say now.
  AlgorithmParameters demanded() const;
  /// Sets the error bits of those that are impossible; whether there is none.
  bool judge(const AlgorithmParameters& parameters);

  const MachineConfig& config_;
  const CoreFacts facts_;
  const Hooks hooks_;
  const Field busy_, ready_, frames_done_field_, output_bytes_;
  const Field faulty_frames_field_;
  const Field enable_;
  const std::vector<Field> widths_, heights_;  // of both blocks
  const std::vector<Field> bytes_available_;   // of both images
  const Address left_, right_, map_, output_, buffer_;
  std::vector<ParameterField> parameter_fields_;  // in the order of run_time_parameters()
  AlgorithmParameters parameters_;                // the last possible ones
  std::uint32_t under_way_ = 0;
  std::uint32_t frames_done_ = 0;
  std::uint32_t frames_faulty_ = 0;
  std::uint64_t output_before_ = 0;  // bytes written before the frame
};

}  // namespace parallax
