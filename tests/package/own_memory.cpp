// SPDX-License-Identifier: Apache-2.0
// A memory of one's own under the machine.
#include <tlm_utils/simple_target_socket.h>

#include <cstdio>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

#include "modules/map_codec.hpp"
#include "platform/config/configuration.hpp"
#include "platform/machine/machine.hpp"
#include "platform/results/run_metrics.hpp"
#include "platform/results/run_summary.hpp"

class SlowMemory final : public sc_core::sc_module {
 public:
  explicit SlowMemory(const sc_core::sc_module_name& name) : sc_module(name) {}

  /// A blocking target does: the socket turns the machine's four phases into calls of it.
  void bind(tlm::tlm_initiator_socket<>& port, const std::string& name) {
    sockets_.push_back(
        std::make_unique<tlm_utils::simple_target_socket<SlowMemory>>(("for_" + name).c_str()));
    sockets_.back()->register_b_transport(this, &SlowMemory::b_transport);
    port.bind(*sockets_.back());
  }

 private:
  void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
    delay += sc_core::sc_time(2, sc_core::SC_US);  // holds no data: that is enough for timing alone
    payload.set_response_status(tlm::TLM_OK_RESPONSE);
  }

  std::vector<std::unique_ptr<tlm_utils::simple_target_socket<SlowMemory>>> sockets_;  // one for each port
};

int sc_main(int, char**) {
  const parallax::Configuration configuration =
      parallax::load_configuration({"scenescan-pro", {}, {}}, {PRESETS});
  const parallax::EncodedMap map =  // of rectified images, of the processed size
      parallax::encode(parallax::identity_map(640, 480, configuration.machine.rectification.range));
  SlowMemory memory("memory");
  parallax::MachineInput input;
  input.width = map.width;
  input.height = map.height;
  input.map = &map;
  input.frames = 9;
  input.timing_only = true;
  input.bind_memory = [&](tlm::tlm_initiator_socket<>& port, const std::string& name) {
    memory.bind(port, name);
  };
  const parallax::Machine machine("machine", configuration.machine, input);
  sc_core::sc_start();  // ends when the host has all frames, unless input.finished says what to do then
  if (!machine.finished()) return 1;
  std::printf("%s", parallax::summary(parallax::measure(machine, {}, 640, 480)).c_str());
  return 0;
}
