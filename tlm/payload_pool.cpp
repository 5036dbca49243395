// SPDX-License-Identifier: Apache-2.0
#include "tlm/payload_pool.hpp"

namespace parallax {

::tlm::tlm_generic_payload& PayloadPool::take(::tlm::tlm_command command, std::uint64_t address,
                                              std::size_t length, bool data) {
  if (free_.empty()) {
    slots_.push_back(std::make_unique<Slot>());
    Slot& slot = *slots_.back();
    slot.data.resize(buffer_bytes_);
    slot.payload.set_mm(this);
    slot.payload.set_data_ptr(slot.data.data());
    free_.push_back(&slot.payload);
  }
  ::tlm::tlm_generic_payload& payload = *free_.back();
  free_.pop_back();
  payload.set_command(command);
  payload.set_address(address);
  payload.set_data_length(static_cast<unsigned>(length));
  payload.set_streaming_width(static_cast<unsigned>(length));
  payload.set_byte_enable_ptr(nullptr);
  payload.set_dmi_allowed(false);
  payload.set_response_status(::tlm::TLM_INCOMPLETE_RESPONSE);
  payload.set_extension(data ? nullptr : &traffic_only_);
  payload.acquire();
  return payload;
}

}  // namespace parallax
