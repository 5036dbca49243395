// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <tlm>
#include <vector>

#include "tlm/traffic_only.hpp"

namespace parallax {

/// Reference-counted payloads with a data buffer each, for initiators that use the non-blocking interface.
class PayloadPool final : public ::tlm::tlm_mm_interface {
 public:
  explicit PayloadPool(std::size_t buffer_bytes) : buffer_bytes_(buffer_bytes) {}

  /// A payload with one reference, ready to send; `length` <= buffer_bytes. Without `data` it carries
  /// TrafficOnly.
  ::tlm::tlm_generic_payload& take(::tlm::tlm_command command, std::uint64_t address, std::size_t length,
                                   bool data = true);

  void free(::tlm::tlm_generic_payload* payload) override { free_.push_back(payload); }

 private:
  struct Slot {
    ::tlm::tlm_generic_payload payload;
    std::vector<std::uint8_t> data;
  };

  std::size_t buffer_bytes_;
  TrafficOnly traffic_only_;
  std::vector<std::unique_ptr<Slot>> slots_;
  std::vector<::tlm::tlm_generic_payload*> free_;
};

}  // namespace parallax
