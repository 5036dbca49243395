// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace parallax {

/// Every number that a run or `parallax memory` can write, from the tables that its values are written with:
/// its name, unit, what it means, and over what it is measured. What stands in angle brackets is a name.
std::string glossary_as_text();
std::string glossary_as_markdown();
nlohmann::ordered_json glossary_as_json();

}  // namespace parallax
