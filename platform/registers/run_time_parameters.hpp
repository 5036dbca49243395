// SPDX-License-Identifier: Apache-2.0
// The table of what software may write into the core's registers beside addresses and sizes. One row a
// parameter: the configuration's field that it stands for, the register's field that it lies in, how, and
// what makes a value impossible. The register map, its documentation, what software writes, and what a start
// decodes and judges follow from the rows.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "platform/config/configuration.hpp"
#include "platform/config/machine_config.hpp"
#include "platform/registers/parameter_member.hpp"
#include "tlm/register_bank.hpp"

namespace parallax {

struct RunTimeParameter;

/// What a start demands of a parameter, and the bit of the register stereo.errors that it sets otherwise.
struct ParameterRule {
  const char* error;                ///< name of the bit
  unsigned bit;                     ///< its number
  const char* error_documentation;  ///< what was wrong when it is set
  const char* documentation;        ///< what the rule adds to the parameter's documentation; may be empty
  /// Whether a machine built as `built` can process a frame with the parameters that are in `asked`.
  bool (*holds)(const RunTimeParameter& parameter, const MachineConfig& asked, const MachineConfig& built);
};

/// One row. Unit, meaning and range are those of the configuration key.
struct RunTimeParameter {
  const char* key;            ///< of the value that software writes first: "matching.p1"
  ParameterMember member;     ///< what the key is bound to
  const char* reg;            ///< of the stereo block
  const char* field;          ///< within the register
  unsigned low;               ///< number of the field's lowest bit
  unsigned width;             ///< bits
  int offset;                 ///< the field holds the value less this, modulo 2^width
  const ParameterRule* rule;  ///< nullptr: whatever the field can hold is possible

  std::uint32_t encode(int value) const { return static_cast<std::uint32_t>(value - offset); }
  int decode(std::uint32_t bits) const { return static_cast<int>(bits) + offset; }
};

/// All rows; those of a register stand together, in the order of their bits.
const std::vector<RunTimeParameter>& run_time_parameters();

/// The parameters that lie in a register of the stereo block, as its fields.
std::vector<RegisterField> parameter_fields(const std::string& reg);

/// The bits of the register stereo.errors: one for each rule of a row. std::logic_error where two rules share
/// a bit.
std::vector<RegisterField> parameter_error_fields();

/// "May change from frame to frame: ..." for the documentation of a configuration key; empty when the key is
/// fixed once the machine is built.
std::string run_time_remark(const std::string& key);

/// Adds it to the documentation of all keys.
void add_run_time_remarks(std::vector<EffectiveKey>& keys);

}  // namespace parallax
