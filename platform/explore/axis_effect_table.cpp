// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/axis_effect_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "platform/explore/exploration_table.hpp"
#include "traces/number_text.hpp"

namespace parallax {

void effects_csv(const std::vector<AxisEffect>& all, ResultStore& store,
                 const std::function<void(const std::string&)>& line) {
  line(csv_line({"number", "unit", "varies", "base", "least", "at_least", "most", "at_most"}));
  for (const AxisEffect& one : all) {
    line(csv_line({one.metric, store.unit(one.metric), one.name, fmt::format("{}", one.base),
                   fmt::format("{}", one.least), one.at_least, fmt::format("{}", one.most), one.at_most}));
  }
}

std::string effects_text(const std::vector<AxisEffect>& all, ResultStore& store, std::size_t most) {
  std::vector<std::vector<std::string>> rows{{"number", "varies", "base", "least", "with", "most", "with"}};
  for (std::size_t i = 0; i < std::min(all.size(), most); ++i) {
    const AxisEffect& one = all[i];
    const std::string unit = store.unit(one.metric);
    rows.push_back({one.metric, one.name, quantity_text(one.base, unit), quantity_text(one.least, unit),
                    one.at_least, quantity_text(one.most, unit), one.at_most});
  }
  return aligned(rows) + (all.size() > most ? fmt::format("and {} more\n", all.size() - most) : "");
}

nlohmann::ordered_json effects_json(const std::vector<AxisEffect>& all, ResultStore& store) {
  auto tree = nlohmann::ordered_json::array();
  for (const AxisEffect& one : all) {
    tree.push_back({{"number", one.metric},
                    {"unit", store.unit(one.metric)},
                    {"varies", one.name},
                    {"base", one.base},
                    {"least", one.least},
                    {"at_least", one.at_least},
                    {"most", one.most},
                    {"at_most", one.at_most}});
  }
  return tree;
}

}  // namespace parallax
