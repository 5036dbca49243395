// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "platform/explore/axis_effect.hpp"
#include "platform/explore/result_store.hpp"

namespace parallax {

/// CSV: a header, then a line for each number and each name that varies, handed out one after the other.
void effects_csv(const std::vector<AxisEffect>& all, ResultStore& store,
                 const std::function<void(const std::string&)>& line);

/// For a reader: at most `most` lines, then how many more there are.
std::string effects_text(const std::vector<AxisEffect>& all, ResultStore& store, std::size_t most);

nlohmann::ordered_json effects_json(const std::vector<AxisEffect>& all, ResultStore& store);

}  // namespace parallax
