// SPDX-License-Identifier: Apache-2.0
#include "tlm/register_bank.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace parallax {
namespace {

constexpr std::uint32_t kBytes = 4;

}  // namespace

RegisterBank::RegisterBank(const sc_core::sc_module_name& name, const std::vector<RegisterBlock>& blocks,
                           const sc_core::sc_time& access_time)
    : sc_module(name), access_time_(access_time) {
  for (const RegisterBlock& block : blocks) {
    for (const Register& reg : block.registers) {
      std::uint32_t used = 0;
      std::uint32_t reset = 0;
      for (const RegisterField& f : reg.fields) {
        if (f.width == 0 || f.low + f.width > 32 || (used & f.mask()) != 0) {
          throw std::logic_error(std::string("the field ") + f.name + " of " + reg.name + " has no place");
        }
        used |= f.mask();
        reset |= f.reset << f.low;
      }
      const std::uint32_t address = block.base + reg.offset;
      if (address % kBytes != 0 || at(address) != nullptr) {
        throw std::logic_error(std::string("the register ") + reg.name + " has no place");
      }
      cells_.push_back({block.name, reg, address, reset});
    }
  }
  socket.register_b_transport(this, &RegisterBank::b_transport);
  socket.register_nb_transport_fw(this, &RegisterBank::nb_transport_fw);
  socket.register_transport_dbg(this, &RegisterBank::transport_dbg);
}

RegisterBank::Cell* RegisterBank::at(std::uint64_t address) {
  const auto found =
      std::find_if(cells_.begin(), cells_.end(), [&](const Cell& c) { return c.address == address; });
  return found == cells_.end() ? nullptr : &*found;
}

const RegisterBank::Cell& RegisterBank::cell(const std::string& block, const std::string& reg) const {
  const auto found = std::find_if(cells_.begin(), cells_.end(), [&](const Cell& c) {
    return c.block == block && reg == c.description.name;
  });
  if (found == cells_.end()) throw std::logic_error("no register " + reg + " in block " + block);
  return *found;
}

RegisterBank::Cell& RegisterBank::cell(const std::string& block, const std::string& reg) {
  return const_cast<Cell&>(static_cast<const RegisterBank&>(*this).cell(block, reg));
}

const RegisterField& RegisterBank::find(const Cell& cell, const std::string& name) {
  for (const RegisterField& f : cell.description.fields) {
    if (name == f.name) return f;
  }
  throw std::logic_error("no field " + name + " in register " + cell.description.name);
}

std::uint32_t RegisterBank::Field::get() const { return (cell_->value & field_->mask()) >> field_->low; }

void RegisterBank::Field::set(std::uint32_t value) const {
  cell_->value = (cell_->value & ~field_->mask()) | (value << field_->low & field_->mask());
}

RegisterBank::Field RegisterBank::field(const std::string& block, const std::string& reg,
                                        const std::string& name) {
  Cell& c = cell(block, reg);
  return {c, find(c, name)};
}

std::uint32_t RegisterBank::get(const std::string& block, const std::string& reg,
                                const std::string& name) const {
  const Cell& c = cell(block, reg);
  const RegisterField& f = find(c, name);
  return (c.value & f.mask()) >> f.low;
}

void RegisterBank::set(const std::string& block, const std::string& reg, const std::string& name,
                       std::uint32_t value) {
  field(block, reg, name).set(value);
}

void RegisterBank::on_write(const std::string& block, const std::string& reg,
                            std::function<void(std::uint32_t triggers)> call) {
  cell(block, reg).written = std::move(call);
}

void RegisterBank::on_read(const std::string& block, const std::string& reg, std::function<void()> call) {
  cell(block, reg).read = std::move(call);
}

void RegisterBank::write(Cell& c, std::uint32_t value) {
  std::uint32_t triggers = 0;
  for (const RegisterField& f : c.description.fields) {
    const std::uint32_t bits = value & f.mask();
    switch (f.access) {
      case FieldAccess::kReadWrite:
        c.value = (c.value & ~f.mask()) | bits;
        break;
      case FieldAccess::kReadOnly:
        break;
      case FieldAccess::kWriteOneToClear:
        c.value &= ~bits;
        break;
      case FieldAccess::kTrigger:
        triggers |= bits;
        break;
    }
  }
  if (c.written) c.written(triggers);
}

// Whole registers in ascending order; false leaves all as it was and the reason in the payload.
bool RegisterBank::access(::tlm::tlm_generic_payload& payload) {
  const std::uint64_t address = payload.get_address();
  const std::uint32_t length = payload.get_data_length();
  const auto refuse = [&payload](::tlm::tlm_response_status status) {
    payload.set_response_status(status);
    return false;
  };
  if (payload.get_byte_enable_ptr() != nullptr) return refuse(::tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE);
  if (address % kBytes != 0 || length == 0 || length % kBytes != 0 ||
      payload.get_streaming_width() < length) {
    return refuse(::tlm::TLM_BURST_ERROR_RESPONSE);
  }
  for (std::uint32_t i = 0; i < length; i += kBytes) {
    if (at(address + i) == nullptr) return refuse(::tlm::TLM_ADDRESS_ERROR_RESPONSE);
  }
  for (std::uint32_t i = 0; i < length; i += kBytes) {
    Cell& c = *at(address + i);
    std::uint8_t* data = payload.get_data_ptr() + i;
    if (payload.is_read()) {
      if (c.read) c.read();
      std::memcpy(data, &c.value, kBytes);
    } else if (payload.is_write()) {
      std::uint32_t value = 0;
      std::memcpy(&value, data, kBytes);
      write(c, value);
    }
  }
  payload.set_response_status(::tlm::TLM_OK_RESPONSE);
  return true;
}

void RegisterBank::b_transport(int, ::tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  access(payload);
  delay += access_time_ * static_cast<double>(std::max(1U, payload.get_data_length() / kBytes));
}

::tlm::tlm_sync_enum RegisterBank::nb_transport_fw(int id, ::tlm::tlm_generic_payload& payload,
                                                   ::tlm::tlm_phase& phase, sc_core::sc_time& delay) {
  if (phase != ::tlm::BEGIN_REQ) {
    SC_REPORT_ERROR("/parallax/registers/phase", "a request must begin with BEGIN_REQ");
    return ::tlm::TLM_COMPLETED;
  }
  b_transport(id, payload, delay);
  phase = ::tlm::END_RESP;
  return ::tlm::TLM_COMPLETED;
}

unsigned RegisterBank::transport_dbg(int, ::tlm::tlm_generic_payload& payload) {
  return access(payload) ? payload.get_data_length() : 0;
}

}  // namespace parallax
