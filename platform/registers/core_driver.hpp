// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tlm_utils/simple_initiator_socket.h>

#include <cstdint>
#include <string>
#include <systemc>
#include <vector>

#include "platform/registers/control_blocks.hpp"
#include "platform/registers/register_word.hpp"

namespace parallax {

/// The device's software as far as it drives the core: register accesses, in the order that a program makes
/// them. Their time is part of software.response_ns.
class CoreDriver final : public sc_core::sc_module {
 public:
  tlm_utils::simple_initiator_socket<CoreDriver> socket{"socket"};

  explicit CoreDriver(const sc_core::sc_module_name& name) : sc_module(name) {}

  /// Enables the core and writes all run-time parameters.
  void write_parameters(const AlgorithmParameters& parameters);
  /// Writes what belongs to a frame and starts it; whether the core has taken it. Old errors are cleared
  /// before, so that those of a refusal stay. The parameters in `command` are not looked at.
  bool start(const FrameCommand& command, const CoreFacts& facts);

  /// One access in no time but that of the bank; SC_REPORT_ERROR /parallax/registers/access when it is
  /// refused.
  std::uint32_t read(const std::string& block, const std::string& reg);
  void write(const std::string& block, const std::string& reg, std::uint32_t value);

 private:
  void access(::tlm::tlm_command command, const std::string& block, const std::string& reg,
              std::uint32_t& value);
  void write(const std::string& block, const std::string& reg, const std::vector<FieldValue>& fields);
  void write_address(const std::string& name, std::uint64_t address);
};

}  // namespace parallax
