// SPDX-License-Identifier: Apache-2.0
#include "platform/registers/core_driver.hpp"

#include <initializer_list>
#include <stdexcept>
#include <utility>

#include "platform/registers/register_map.hpp"

namespace parallax {
namespace {

const Register& find(const std::string& block, const std::string& reg, std::uint32_t& base) {
  for (const RegisterBlock& b : register_blocks()) {
    if (block != b.name) continue;
    base = b.base;
    for (const Register& r : b.registers) {
      if (reg == r.name) return r;
    }
  }
  throw std::logic_error("no register " + reg + " in block " + block);
}

std::uint32_t compose(const std::string& block, const std::string& reg,
                      std::initializer_list<std::pair<const char*, int>> values) {
  std::uint32_t base = 0;
  std::uint32_t word = 0;
  for (const auto& [name, value] : values) {
    for (const RegisterField& f : find(block, reg, base).fields) {
      if (std::string(name) == f.name) word |= static_cast<std::uint32_t>(value) << f.low & f.mask();
    }
  }
  return word;
}

}  // namespace

void CoreDriver::access(::tlm::tlm_command command, const std::string& block, const std::string& reg,
                        std::uint32_t& value) {
  std::uint32_t base = 0;
  const std::uint32_t address = find(block, reg, base).offset + base;
  ::tlm::tlm_generic_payload payload;
  payload.set_command(command);
  payload.set_address(address);
  payload.set_data_ptr(reinterpret_cast<std::uint8_t*>(&value));
  payload.set_data_length(sizeof value);
  payload.set_streaming_width(sizeof value);
  sc_core::sc_time delay;
  socket->b_transport(payload, delay);
  if (payload.is_response_error()) {
    SC_REPORT_ERROR("/parallax/registers/access",
                    (block + "." + reg + ": " + payload.get_response_string()).c_str());
  }
}

std::uint32_t CoreDriver::read(const std::string& block, const std::string& reg) {
  std::uint32_t value = 0;
  access(::tlm::TLM_READ_COMMAND, block, reg, value);
  return value;
}

void CoreDriver::write(const std::string& block, const std::string& reg, std::uint32_t value) {
  access(::tlm::TLM_WRITE_COMMAND, block, reg, value);
}

void CoreDriver::write_address(const std::string& name, std::uint64_t address) {
  write("dma", name + "_address_high", static_cast<std::uint32_t>(address >> 32));
  write("dma", name + "_address_low", static_cast<std::uint32_t>(address));
}

void CoreDriver::write_parameters(const MachineConfig& config, const AlgorithmParameters& p) {
  constexpr int kUnit = 256;
  write("stereo", "control",
        compose("stereo", "control", {{"enable", 1}, {"iterations", config.matching.iterations - 1}}));
  write("stereo", "algorithm_parameters_1",
        compose("stereo", "algorithm_parameters_1",
                {{"p1", p.p1}, {"p2", p.p2}, {"uniqueness", p.uniqueness_factor - kUnit}}));
  write("stereo", "algorithm_parameters_2",
        compose("stereo", "algorithm_parameters_2",
                {{"texture", p.texture_threshold},
                 {"consistency", p.consistency_threshold},
                 {"offset", config.matching.disparity_offset},
                 {"speckle_iterations", p.speckle_iterations},
                 {"mask_border", p.mask_border ? 1 : 0},
                 {"uniqueness_enable", p.uniqueness ? 1 : 0},
                 {"consistency_enable", p.consistency ? 1 : 0},
                 {"texture_enable", p.texture ? 1 : 0},
                 {"gap_enable", p.gap_interpolation ? 1 : 0},
                 {"noise_enable", p.noise_reduction ? 1 : 0}}));
}

bool CoreDriver::start(const FrameCommand& command, const CoreFacts& facts) {
  if (const std::uint32_t old = read("dma", "errors"); old != 0) write("dma", "errors", old);
  for (const char* block : {"dma", "stereo"}) {
    write(block, "image_size",
          compose(block, "image_size", {{"width", facts.width}, {"height", facts.height}}));
  }
  write_address("left", command.left);
  write_address("right", command.right);
  write_address("map", command.map);
  write_address("output", command.output);
  write_address("buffer", command.buffer);
  write("dma", "left_bytes_available", static_cast<std::uint32_t>(facts.start_bytes));
  write("dma", "right_bytes_available", static_cast<std::uint32_t>(facts.start_bytes));
  write("dma", "control", compose("dma", "control", {{"start", 1}}));
  return read("dma", "errors") == 0;
}

}  // namespace parallax
