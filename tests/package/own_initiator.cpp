// SPDX-License-Identifier: Apache-2.0
// An initiator of one's own on the DRAM memory.
#include <tlm_utils/simple_initiator_socket.h>

#include <cstdio>
#include <memory>
#include <systemc>

#include "tlm/dram_scheduler.hpp"
#include "tlm/memory.hpp"

class Reader final : public sc_core::sc_module {
 public:
  tlm_utils::simple_initiator_socket<Reader> socket{"socket"};

  explicit Reader(const sc_core::sc_module_name& name) : sc_module(name) {
    SC_HAS_PROCESS(Reader);
    SC_THREAD(run);
  }
  sc_core::sc_time latency;  // of the last read

 private:
  void run() {
    unsigned char bytes[64];
    for (int i = 0; i < 2; ++i) {
      tlm::tlm_generic_payload payload;
      payload.set_command(tlm::TLM_READ_COMMAND);
      payload.set_address(64 * static_cast<sc_dt::uint64>(i));
      payload.set_data_ptr(bytes);
      payload.set_data_length(sizeof bytes);
      payload.set_streaming_width(sizeof bytes);
      sc_core::sc_time delay;
      const sc_core::sc_time begin = sc_core::sc_time_stamp();
      socket->b_transport(payload, delay);
      wait(delay);
      latency = sc_core::sc_time_stamp() - begin;
    }
  }
};

int sc_main(int, char**) {
  parallax::DramMemory dram;  // DDR3-1066, 32 bit; load_dram_device() in platform reads another one by name
  parallax::MemoryTargetConfig target;
  target.size = parallax::Bytes(dram.timing.bytes());
  parallax::Memory memory("memory", target, std::make_unique<parallax::DramScheduler>(dram));
  Reader reader("reader");
  reader.socket.bind(memory.socket);  // any number of initiators; each binding is a port
  sc_core::sc_start();
  std::printf("row hit: %.1f ns\n", reader.latency.to_seconds() * 1e9);
  return reader.latency == sc_core::sc_time(30, sc_core::SC_NS) ? 0 : 1;
}
