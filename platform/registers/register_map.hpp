// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tlm/register_bank.hpp"

namespace parallax {

/// The core's two control blocks: which registers there are and in which order is published, their offsets
/// are reconstructed; bit fields are our own. Code, documentation (REGISTERS.md) and the C header come from
/// this table.
const std::vector<RegisterBlock>& register_blocks();

/// The table as Markdown, as a C header of offsets, shifts and masks, and as lines of text.
std::string registers_as_markdown();
std::string registers_as_header();
std::string registers_as_text();

}  // namespace parallax
