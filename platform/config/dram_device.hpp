// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "platform/config/config_value.hpp"
#include "tlm/dram_timing.hpp"

namespace parallax {

class Schema;

/// A DRAM device file's keys: the rank of devices as DramTiming has it.
void describe(Schema& schema, DramTiming& timing);

/// The values of a device's file and of those that it inherits: keys dram.*; see load_dram_device().
RawConfig read_dram_device(const std::string& name, const std::vector<std::filesystem::path>& preset_folders);

/// A device by name, from `memory/<name>.toml` in the preset folders, or by path. Throws UserError, one line:
/// not found, unreadable, an unknown key, a value out of range.
DramTiming load_dram_device(const std::string& name,
                            const std::vector<std::filesystem::path>& preset_folders);

}  // namespace parallax
