// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tlm_utils/multi_passthrough_target_socket.h>

#include <cstdint>
#include <functional>
#include <string>
#include <systemc>
#include <tlm>
#include <vector>

namespace parallax {

/// What a write from the bus does to a field.
enum class FieldAccess {
  kReadWrite,
  kReadOnly,         ///< nothing: the hardware sets it
  kWriteOneToClear,  ///< bits that are written as 1 become 0
  kTrigger,          ///< a 1 starts something; reads as 0
};

struct RegisterField {
  const char* name;
  unsigned low;    ///< number of the lowest bit
  unsigned width;  ///< bits, 1 to 32
  FieldAccess access;
  std::uint32_t reset;
  std::string documentation;

  std::uint32_t mask() const { return (width == 32 ? ~0U : (1U << width) - 1) << low; }
};

struct Register {
  const char* name;
  std::uint32_t offset;  ///< B, a multiple of 4
  const char* documentation;
  std::vector<RegisterField> fields;  ///< that do not overlap; bits between them read as 0
};

/// One block of a design's control registers.
struct RegisterBlock {
  const char* name;
  std::uint32_t base;  ///< B
  const char* documentation;
  std::vector<Register> registers;
};

/// Blocks of 32-bit registers behind a TLM-2.0 socket that any number of initiators may bind. b_transport
/// takes `access_time` for each register, annotated; nb_transport answers at once with that delay;
/// transport_dbg takes none and has the effect of a read or a write. An access is one or more whole
/// registers: addresses and lengths that are no multiple of 4 are answered with TLM_BURST_ERROR_RESPONSE, an
/// address without a register with TLM_ADDRESS_ERROR_RESPONSE, byte enables and streaming with their errors;
/// nothing is written then.
class RegisterBank final : public sc_core::sc_module {
  struct Cell;

 public:
  /// A field as the hardware reads and sets it. Valid as long as its bank.
  class Field {
   public:
    std::uint32_t get() const;
    /// Bits of `value` beyond the field are left out.
    void set(std::uint32_t value) const;

   private:
    friend class RegisterBank;
    Field(Cell& cell, const RegisterField& field) : cell_(&cell), field_(&field) {}

    Cell* cell_;
    const RegisterField* field_;
  };

  tlm_utils::multi_passthrough_target_socket<RegisterBank> socket{"socket"};

  /// Throws std::logic_error for a table that contradicts itself.
  RegisterBank(const sc_core::sc_module_name& name, const std::vector<RegisterBlock>& blocks,
               const sc_core::sc_time& access_time);

  /// The hardware's side. Names are those of the table; std::logic_error when there is none. Who reads or
  /// sets a field often finds it once.
  Field field(const std::string& block, const std::string& reg, const std::string& field);
  std::uint32_t get(const std::string& block, const std::string& reg, const std::string& field) const;
  void set(const std::string& block, const std::string& reg, const std::string& field, std::uint32_t value);
  /// Called after a write from the bus has changed the register, with the bits of its triggers that were
  /// written as 1.
  void on_write(const std::string& block, const std::string& reg,
                std::function<void(std::uint32_t triggers)> call);
  /// Called before a read from the bus, to bring fields up to date.
  void on_read(const std::string& block, const std::string& reg, std::function<void()> call);

 private:
  struct Cell {
    std::string block;
    Register description;
    std::uint32_t address;
    std::uint32_t value;
    std::function<void(std::uint32_t)> written{};
    std::function<void()> read{};
  };

  void b_transport(int id, ::tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  ::tlm::tlm_sync_enum nb_transport_fw(int id, ::tlm::tlm_generic_payload& payload, ::tlm::tlm_phase& phase,
                                       sc_core::sc_time& delay);
  unsigned transport_dbg(int id, ::tlm::tlm_generic_payload& payload);
  bool access(::tlm::tlm_generic_payload& payload);
  void write(Cell& cell, std::uint32_t value);
  Cell* at(std::uint64_t address);
  Cell& cell(const std::string& block, const std::string& reg);
  const Cell& cell(const std::string& block, const std::string& reg) const;
  static const RegisterField& find(const Cell& cell, const std::string& name);

  std::vector<Cell> cells_;
  const sc_core::sc_time access_time_;
};

}  // namespace parallax
