// SPDX-License-Identifier: Apache-2.0
#include "tlm/register_bank.hpp"

#include <gtest/gtest.h>
#include <tlm_utils/simple_initiator_socket.h>

#include <array>
#include <stdexcept>

#include "tests/tlm/thread.hpp"

namespace parallax::test {
namespace register_bank_test {

using A = FieldAccess;

std::vector<RegisterBlock> table() {
  return {{"one",
           0x10,
           "",
           {{"mixed",
             0x0,
             "",
             {{"number", 4, 8, A::kReadWrite, 0x5A, ""},
              {"fixed", 12, 4, A::kReadOnly, 0x3, ""},
              {"flags", 16, 4, A::kWriteOneToClear, 0xF, ""},
              {"go", 31, 1, A::kTrigger, 0, ""}}},
            {"whole", 0x4, "", {{"all", 0, 32, A::kReadWrite, 7, ""}}}}},
          {"two", 0x20, "", {{"whole", 0x0, "", {{"all", 0, 32, A::kReadOnly, 9, ""}}}}}};
}

struct Master final : sc_core::sc_module {
  tlm_utils::simple_initiator_socket<Master> socket{"socket"};
  explicit Master(const sc_core::sc_module_name& name) : sc_module(name) {}

  ::tlm::tlm_generic_payload payload;
  std::array<std::uint32_t, 4> data{};
  sc_core::sc_time delay;

  ::tlm::tlm_generic_payload& prepare(::tlm::tlm_command command, std::uint64_t address, unsigned bytes) {
    payload.set_command(command);
    payload.set_address(address);
    payload.set_data_ptr(reinterpret_cast<std::uint8_t*>(data.data()));
    payload.set_data_length(bytes);
    payload.set_streaming_width(bytes);
    payload.set_byte_enable_ptr(nullptr);
    payload.set_response_status(::tlm::TLM_INCOMPLETE_RESPONSE);
    delay = sc_core::SC_ZERO_TIME;
    return payload;
  }
  ::tlm::tlm_response_status access(::tlm::tlm_command command, std::uint64_t address, unsigned bytes = 4) {
    socket->b_transport(prepare(command, address, bytes), delay);
    return payload.get_response_status();
  }
  std::uint32_t read(std::uint64_t address) {
    EXPECT_EQ(access(::tlm::TLM_READ_COMMAND, address), ::tlm::TLM_OK_RESPONSE);
    return data[0];
  }
  void write(std::uint64_t address, std::uint32_t value) {
    data[0] = value;
    EXPECT_EQ(access(::tlm::TLM_WRITE_COMMAND, address), ::tlm::TLM_OK_RESPONSE);
  }
};

struct Bench {
  RegisterBank bank{"bank", table(), sc_core::sc_time(100, sc_core::SC_NS)};
  Master master{"master"};
  Bench() { master.socket.bind(bank.socket); }
  void run(std::function<void()> body) {
    const Thread thread("thread", std::move(body));
    sc_core::sc_start();
  }
};

TEST(RegisterBank, EachFieldTakesWritesAsItsAccessSays) {
  Bench b;
  std::uint32_t triggers = 1;
  b.bank.on_write("one", "mixed", [&](std::uint32_t bits) { triggers = bits; });
  b.run([&] {
    EXPECT_EQ(b.master.read(0x10), 0x000F35A0u);
    b.master.write(0x10, 0x00020120);
    EXPECT_EQ(triggers, 0u);
    EXPECT_EQ(b.master.read(0x10), 0x000D3120u);  // 0x12 in the number, one flag less
    b.master.write(0x10, 0xFFFFFFFF);
    EXPECT_EQ(triggers, 0x80000000u);
    EXPECT_EQ(b.master.read(0x10), 0x00003FF0u);
    EXPECT_EQ(b.bank.get("one", "mixed", "number"), 0xFFu);
    b.bank.set("one", "mixed", "flags", 5);
    b.bank.set("one", "mixed", "fixed", 0xFF);  // no wider than the field
    EXPECT_EQ(b.master.read(0x10), 0x0005FFF0u);
    b.master.write(0x20, 1);
    EXPECT_EQ(b.master.read(0x20), 9u);
  });
}

TEST(RegisterBank, SeveralRegistersInOneAccess) {
  Bench b;
  b.run([&] {
    b.master.data = {0, 0x12345678};
    EXPECT_EQ(b.master.access(::tlm::TLM_WRITE_COMMAND, 0x10, 8), ::tlm::TLM_OK_RESPONSE);
    EXPECT_EQ(b.master.delay, sc_core::sc_time(200, sc_core::SC_NS));
    EXPECT_EQ(b.master.read(0x14), 0x12345678u);
    EXPECT_EQ(b.master.delay, sc_core::sc_time(100, sc_core::SC_NS));
  });
}

TEST(RegisterBank, AReadBringsItUpToDateBefore) {
  Bench b;
  std::uint32_t asked = 0;
  b.bank.on_read("two", "whole", [&] { b.bank.set("two", "whole", "all", ++asked * 10); });
  b.run([&] {
    EXPECT_EQ(b.master.read(0x20), 10u);
    EXPECT_EQ(b.master.read(0x20), 20u);
  });
}

TEST(RegisterBank, AFieldFoundOnceIsThatOfTheName) {
  Bench b;
  const RegisterBank::Field number = b.bank.field("one", "mixed", "number");
  EXPECT_EQ(number.get(), 0x5Au);
  number.set(0x134);
  EXPECT_EQ(number.get(), 0x34u);
  EXPECT_EQ(b.bank.get("one", "mixed", "number"), 0x34u);
  EXPECT_EQ(b.bank.get("one", "mixed", "fixed"), 0x3u);
  EXPECT_THROW(b.bank.field("one", "mixed", "none"), std::logic_error);
}

TEST(RegisterBank, RefusesWhatIsNoAccessToRegisters) {
  Bench b;
  b.run([&] {
    EXPECT_EQ(b.master.access(::tlm::TLM_READ_COMMAND, 0x11), ::tlm::TLM_BURST_ERROR_RESPONSE);
    EXPECT_EQ(b.master.access(::tlm::TLM_READ_COMMAND, 0x10, 2), ::tlm::TLM_BURST_ERROR_RESPONSE);
    EXPECT_EQ(b.master.access(::tlm::TLM_READ_COMMAND, 0x10, 0), ::tlm::TLM_BURST_ERROR_RESPONSE);
    EXPECT_EQ(b.master.access(::tlm::TLM_READ_COMMAND, 0x18), ::tlm::TLM_ADDRESS_ERROR_RESPONSE);
    EXPECT_EQ(b.master.access(::tlm::TLM_READ_COMMAND, ~0ull - 3), ::tlm::TLM_ADDRESS_ERROR_RESPONSE);
    // The second register is none, so the first one is not written.
    b.master.data = {1, 2};
    EXPECT_EQ(b.master.access(::tlm::TLM_WRITE_COMMAND, 0x14, 8), ::tlm::TLM_ADDRESS_ERROR_RESPONSE);
    EXPECT_EQ(b.master.read(0x14), 7u);
    std::uint8_t enable = 0xFF;
    ::tlm::tlm_generic_payload& enabled = b.master.prepare(::tlm::TLM_READ_COMMAND, 0x10, 4);
    enabled.set_byte_enable_ptr(&enable);
    b.master.socket->b_transport(enabled, b.master.delay);
    EXPECT_EQ(enabled.get_response_status(), ::tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE);
    ::tlm::tlm_generic_payload& streaming = b.master.prepare(::tlm::TLM_READ_COMMAND, 0x10, 8);
    streaming.set_streaming_width(4);
    b.master.socket->b_transport(streaming, b.master.delay);
    EXPECT_EQ(streaming.get_response_status(), ::tlm::TLM_BURST_ERROR_RESPONSE);
  });
}

TEST(RegisterBank, TheOtherInterfacesSayTheSame) {
  Bench b;
  b.run([&] {
    ::tlm::tlm_phase phase = ::tlm::BEGIN_REQ;
    ::tlm::tlm_generic_payload& payload = b.master.prepare(::tlm::TLM_READ_COMMAND, 0x14, 4);
    EXPECT_EQ(b.master.socket->nb_transport_fw(payload, phase, b.master.delay), ::tlm::TLM_COMPLETED);
    EXPECT_EQ(b.master.data[0], 7u);
    EXPECT_EQ(b.master.delay, sc_core::sc_time(100, sc_core::SC_NS));
    EXPECT_EQ(b.master.socket->transport_dbg(b.master.prepare(::tlm::TLM_READ_COMMAND, 0x20, 4)), 4u);
    EXPECT_EQ(b.master.data[0], 9u);
    EXPECT_EQ(b.master.socket->transport_dbg(b.master.prepare(::tlm::TLM_READ_COMMAND, 0x24, 4)), 0u);
    phase = ::tlm::END_RESP;
    EXPECT_THROW(b.master.socket->nb_transport_fw(payload, phase, b.master.delay), sc_core::sc_report);
  });
}

TEST(RegisterBank, ATableThatContradictsItselfIsRefused) {
  const auto make = [](std::vector<RegisterField> fields, std::uint32_t second) {
    const std::vector<RegisterBlock> blocks{
        {"a", 0, "", {{"x", 0, "", std::move(fields)}, {"y", second, "", {}}}}};
    RegisterBank bank("bank", blocks, sc_core::SC_ZERO_TIME);
  };
  EXPECT_THROW(make({{"f", 0, 8, A::kReadWrite, 0, ""}, {"g", 7, 2, A::kReadWrite, 0, ""}}, 4),
               std::logic_error);
  EXPECT_THROW(make({{"f", 30, 3, A::kReadWrite, 0, ""}}, 4), std::logic_error);
  EXPECT_THROW(make({}, 0), std::logic_error);
  EXPECT_THROW(make({}, 6), std::logic_error);
  Bench b;
  EXPECT_THROW(b.bank.get("one", "none", "all"), std::logic_error);
  EXPECT_THROW(b.bank.get("one", "whole", "none"), std::logic_error);
}

}  // namespace register_bank_test
}  // namespace parallax::test
