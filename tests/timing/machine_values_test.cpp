// SPDX-License-Identifier: Apache-2.0
// A slow, narrow or unfair memory changes the machine's times and nothing else.
#include <gtest/gtest.h>
#include <tlm_utils/simple_target_socket.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <sstream>

#include "tests/timing/in_child.hpp"
#include "tests/timing/machine_bench.hpp"

namespace parallax::test {
namespace machine_values_test {

constexpr int kWidth = 64;
constexpr int kHeight = 32;

SensorImage image(std::uint32_t seed) {
  std::mt19937 random(seed);
  auto pixels = std::make_shared<std::vector<Gray>>(static_cast<std::size_t>(kWidth * kHeight));
  for (std::size_t i = 0; i < pixels->size(); ++i) {
    // Coarse blocks, so that some of it matches.
    (*pixels)[i] = static_cast<Gray>((i / 5 * 37 + i / 64 / 3 * 91) % 200 + random() % 20);
  }
  return pixels;
}

// The results of three frames as text, and after a line the time of the last one.
std::string results(const MachineConfig& config, const std::function<void(MachineInput&)>& bring = nullptr) {
  return in_child([&] {
    const EncodedMap map = encode(lens_map(kWidth, kHeight, config.rectification.range));
    std::ostringstream out;
    MachineInput input;
    input.width = kWidth;
    input.height = kHeight;
    input.map = &map;
    input.frames = 3;
    input.expose = [](std::int64_t frame) {
      const auto seed = static_cast<std::uint32_t>(frame);
      return StereoFrame{image(seed), image(seed + 1)};
    };
    input.deliver = [&](const FrameResult& result) {
      for (const Gray pixel : result.left) out << int{pixel} << " ";
      for (const Disparity& disparity : result.disparities) {
        out << disparity.value << "/" << static_cast<int>(disparity.cause) << " ";
      }
    };
    if (bring) bring(input);
    const Machine machine("machine", config, input);
    sc_core::sc_start();
    if (!machine.finished()) return "stuck:\n" + describe(machine.dataflow().waits());
    out << "\n" << machine.snapshots().back().time;
    return out.str();
  });
}

/// A memory as somebody else might have it: loosely timed, a socket a port, the blocking interface alone.
class ForeignMemory final : public sc_core::sc_module {
 public:
  explicit ForeignMemory(const sc_core::sc_module_name& name) : sc_module(name), bytes_(1 << 20) {}

  void bind(::tlm::tlm_initiator_socket<>& initiator, const std::string& port) {
    sockets_.push_back(std::make_unique<Socket>(port.c_str()));
    sockets_.back()->register_b_transport(this, &ForeignMemory::b_transport);
    sockets_.back()->register_transport_dbg(this, &ForeignMemory::transport_dbg);
    initiator.bind(*sockets_.back());
  }

 private:
  using Socket = tlm_utils::simple_target_socket<ForeignMemory>;

  void b_transport(::tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
    transport_dbg(payload);
    delay += sc_core::sc_time(70 + payload.get_data_length(), sc_core::SC_NS);
  }
  unsigned transport_dbg(::tlm::tlm_generic_payload& payload) {
    const std::size_t begin = payload.get_address();
    const std::size_t length = payload.get_data_length();
    if (begin + length > bytes_.size()) {
      payload.set_response_status(::tlm::TLM_ADDRESS_ERROR_RESPONSE);
      return 0;
    }
    std::uint8_t* stored = bytes_.data() + begin;
    if (payload.is_read()) std::copy_n(stored, length, payload.get_data_ptr());
    if (payload.is_write()) std::copy_n(payload.get_data_ptr(), length, stored);
    payload.set_response_status(::tlm::TLM_OK_RESPONSE);
    return payload.get_data_length();
  }

  std::vector<std::uint8_t> bytes_;
  std::vector<std::unique_ptr<Socket>> sockets_;
};

std::string values(const std::string& text) { return text.substr(0, text.find('\n')); }
std::string time(const std::string& text) { return text.substr(text.find('\n')); }

MachineConfig small(std::vector<std::string> assignments) {
  assignments.insert(assignments.begin(), {"rectification.window=9", "matching.iterations=1"});
  return preset(assignments);
}

TEST(MachineValues, DoNotDependOnTheMemory) {
  const std::string usual = results(small({}));
  ASSERT_GT(values(usual).size(), 3u * kWidth * kHeight * 4) << usual;
  const std::vector<std::vector<std::string>> others{
      {"memory.latency_cycles=5000"},
      {"memory.model=bus", "memory.bytes_per_cycle=1", "memory.efficiency=3"},
      {"memory.device=ddr4-2400-x64", "memory.mapping=rbcg"},
      {"memory.device=lpddr4-3200-x32", "memory.mapping=brc", "memory_map.alignment=32768"},
      {"matching.path_storage=memory"},
      {"camera.early_start_rows=1"},
      {"link.early_start_rows=1"},
      {"camera.early_start_rows=3", "link.early_start_rows=5", "memory.model=bus", "memory.bytes_per_cycle=1",
       "dma.camera.burst_bytes=24", "dma.camera.data_bits=8", "link.host_pixel_rate=0"},
      {"camera.fault=missing_row", "camera.fault_every=2", "camera.fault_rows=7"},
      {"camera.skew_ns=10000", "camera.exposure_ns=30000", "camera.overlap=false"},
      {"matching.path_storage=memory", "dma.buffer.data_bits=8", "dma.buffer.outstanding=1"},
      {"camera.format=mono12_packed"},
      {"link.color_output=true"},
      {"camera.format=mono12", "dma.left.burst_bytes=8"},
      {"camera.format=rgb8", "dma.right.burst_bytes=16", "memory_map.alignment=1"},
      {"camera.format=rgb8", "dma.camera.burst_bytes=8"},
      {"memory.queue_depth=1", "memory.arbitration=fixed_priority"},
      {"memory.model=bus", "clocks.memory_hz=10000019", "memory.queue_depth=1"},
      {"dma.left.outstanding=1", "dma.map.fifo_bytes=128", "dma.output.outstanding=1"},
      {"dma.left.fifo_bytes=128", "dma.right.fifo_bytes=256", "dma.link.fifo_bytes=128"},
      {"dma.left.burst_bytes=8", "dma.right.burst_bytes=4096", "dma.right.fifo_bytes=4096"},
      {"camera.frame_buffers=1", "link.output_buffers=1"}};
  int times_that_changed = 0;
  for (const std::vector<std::string>& assignments : others) {
    const std::string other = results(small(assignments));
    EXPECT_EQ(values(other), values(usual)) << assignments[0];
    times_that_changed += time(other) != time(usual) ? 1 : 0;
  }
  EXPECT_GE(times_that_changed, 5);  // small changes vanish behind the host's pace
}

TEST(MachineValues, DoNotDependOnWhoseMemoryItIs) {
  const std::string own = results(small({}));
  const std::string other = results(small({}), [](MachineInput& input) {
    // It lives as long as the process, which is this run's.
    auto* memory = new ForeignMemory("memory");
    input.bind_memory = [memory](::tlm::tlm_initiator_socket<>& socket, const std::string& port) {
      memory->bind(socket, port);
    };
  });
  EXPECT_EQ(values(other), values(own)) << other.substr(0, 200);
  EXPECT_NE(time(other), time(own));
}

}  // namespace machine_values_test
}  // namespace parallax::test
