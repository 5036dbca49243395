// SPDX-License-Identifier: Apache-2.0
#include "platform/registers/core_driver.hpp"

#include "platform/registers/register_word.hpp"
#include "platform/registers/run_time_parameters.hpp"

namespace parallax {

void CoreDriver::access(::tlm::tlm_command command, const std::string& block, const std::string& reg,
                        std::uint32_t& value) {
  ::tlm::tlm_generic_payload payload;
  payload.set_command(command);
  payload.set_address(find_register(block, reg).address);
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

void CoreDriver::write(const std::string& block, const std::string& reg,
                       const std::vector<FieldValue>& fields) {
  write(block, reg, compose(find_register(block, reg).description, fields));
}

void CoreDriver::write_parameters(const AlgorithmParameters& parameters) {
  const std::vector<RunTimeParameter>& rows = run_time_parameters();
  for (std::size_t i = 0; i < rows.size();) {
    const std::string reg = rows[i].reg;
    std::vector<FieldValue> fields;
    if (reg == "control") fields.emplace_back("enable", 1);
    for (; i < rows.size() && reg == rows[i].reg; ++i) {
      fields.emplace_back(rows[i].field, rows[i].encode(parameters.values.at(i)));
    }
    write("stereo", reg, fields);
  }
}

bool CoreDriver::start(const FrameCommand& command, const CoreFacts& facts) {
  if (const std::uint32_t old = read("dma", "errors"); old != 0) write("dma", "errors", old);
  for (const char* block : {"dma", "stereo"}) {
    write(block, "image_size",
          {{"width", static_cast<std::uint32_t>(facts.width)},
           {"height", static_cast<std::uint32_t>(facts.height)}});
  }
  write_address("left", command.left);
  write_address("right", command.right);
  write_address("map", command.map);
  write_address("output", command.output);
  write_address("buffer", command.buffer);
  write("dma", "left_bytes_available", static_cast<std::uint32_t>(facts.start_bytes));
  write("dma", "right_bytes_available", static_cast<std::uint32_t>(facts.start_bytes));
  write("dma", "control", std::vector<FieldValue>{{"start", 1}});
  return read("dma", "errors") == 0;
}

}  // namespace parallax
