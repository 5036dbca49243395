// SPDX-License-Identifier: Apache-2.0
// What the matcher keeps in memory comes back as it was, and nothing else would go unnoticed.
#include <gtest/gtest.h>
#include <tlm_utils/simple_target_socket.h>

#include <cstring>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "tests/timing/in_child.hpp"
#include "tests/timing/machine_bench.hpp"

namespace parallax::test {
namespace kept_values_test {

constexpr int kWidth = 48;
constexpr int kHeight = 32;
constexpr const char* kEight = "matching.paths=w,nw,n,ne,e,sw,s,se";

SensorImage noise(std::uint32_t seed) {
  std::mt19937 random(seed);
  auto pixels = std::make_shared<std::vector<Gray>>();
  for (int i = 0; i < kWidth * kHeight; ++i) pixels->push_back(static_cast<Gray>(random() % 256));
  return pixels;
}

/// A port of a memory that it shares with others; bit 0 of what is read at `faulty` or above is wrong.
class MemoryPortModel final : public sc_core::sc_module {
 public:
  static constexpr std::uint64_t kNever = ~std::uint64_t{0};

  MemoryPortModel(const sc_core::sc_module_name& name, std::vector<std::uint8_t>& bytes, std::uint64_t faulty)
      : sc_module(name), bytes_(bytes), faulty_(faulty) {
    socket.register_b_transport(this, &MemoryPortModel::b_transport);
    socket.register_transport_dbg(this, &MemoryPortModel::transport_dbg);
  }
  tlm_utils::simple_target_socket<MemoryPortModel> socket{"socket"};

 private:
  void b_transport(::tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
    transport_dbg(payload);
    delay += sc_core::sc_time(40, sc_core::SC_NS);
  }
  unsigned transport_dbg(::tlm::tlm_generic_payload& payload) {
    std::uint8_t* const here = bytes_.data() + payload.get_address();
    const unsigned length = payload.get_data_length();
    if (payload.is_write()) {
      std::memcpy(here, payload.get_data_ptr(), length);
    } else {
      std::memcpy(payload.get_data_ptr(), here, length);
      if (payload.get_address() >= faulty_) payload.get_data_ptr()[0] ^= 1u;
    }
    payload.set_response_status(::tlm::TLM_OK_RESPONSE);
    return length;
  }

  std::vector<std::uint8_t>& bytes_;
  const std::uint64_t faulty_;
};

/// The results of three frames as text; reads through `faulty_port` are wrong.
std::string results(const std::vector<std::string>& assignments, const std::string& faulty_port = "") {
  return in_child([&] {
    std::vector<std::string> all{"rectification.window=9", "matching.iterations=1", "memory.model=bus",
                                 "memory.size_bytes=16777216"};
    all.insert(all.end(), assignments.begin(), assignments.end());
    const MachineConfig config = preset(all);
    const EncodedMap map = encode(lens_map(kWidth, kHeight, config.rectification.range));
    std::vector<std::uint8_t> bytes(1 << 24);
    std::vector<std::unique_ptr<MemoryPortModel>> ports;
    std::ostringstream out;
    MachineInput input;
    input.width = kWidth;
    input.height = kHeight;
    input.map = &map;
    input.frames = 3;
    input.expose = [](std::int64_t frame) {
      const auto seed = static_cast<std::uint32_t>(frame);
      return StereoFrame{noise(seed), noise(seed)};
    };
    input.deliver = [&](const FrameResult& result) {
      for (const Disparity& disparity : result.disparities) out << disparity.value << " ";
    };
    input.bind_memory = [&](::tlm::tlm_initiator_socket<>& socket, const std::string& port) {
      const std::uint64_t faulty = port == faulty_port ? 0 : MemoryPortModel::kNever;
      ports.push_back(std::make_unique<MemoryPortModel>((port + "_memory").c_str(), bytes, faulty));
      socket.bind(ports.back()->socket);
    };
    const Machine machine("machine", config, input);
    sc_core::sc_start();
    return machine.finished() ? out.str() : "stuck:\n" + describe(machine.dataflow().waits());
  });
}

TEST(KeptValues, ResultsDoNotDependOnWherePathCostsLie) {
  const std::string rows = results({"matching.path_storage=memory"});
  EXPECT_EQ(rows, results({}));
  EXPECT_EQ(rows.find_first_not_of("0123456789 "), std::string::npos) << rows.substr(0, 200);
  EXPECT_EQ(results({"matching.path_storage=memory", kEight}), results({kEight}));
  EXPECT_EQ(results({"matching.path_storage=memory", "tiles.limit=32"}), results({"tiles.limit=32"}));
}

TEST(KeptValues, ARowThatComesBackOtherwiseIsReported) {
  const std::string text = results({"matching.path_storage=memory"}, "buffer_row_read");
  EXPECT_NE(text.find("/parallax/matching/kept"), std::string::npos) << text.substr(0, 200);
}

TEST(KeptValues, AFrameThatComesBackOtherwiseIsReported) {
  const std::string text = results({kEight}, "buffer_frame_read");
  EXPECT_NE(text.find("/parallax/matching/kept"), std::string::npos) << text.substr(0, 200);
}

}  // namespace kept_values_test
}  // namespace parallax::test
