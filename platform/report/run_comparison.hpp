// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "platform/report/run_report.hpp"

namespace parallax {

/// What is not the same in two runs.
struct RunComparison {
  struct Difference {
    std::string name;          ///< "clocks/core_hz", "performance/frame_rate"
    nlohmann::ordered_json a;  ///< null: not in that run
    nlohmann::ordered_json b;
    std::string unit;

    /// In percent; none where a share changes, or from or to nothing.
    std::optional<double> change() const;
    // For a person.
    std::string change_text() const;  ///< empty: none
    std::string text_a() const;
    std::string text_b() const;
  };
  std::string path_a;
  std::string path_b;
  std::vector<Difference> configuration;
  std::vector<Difference> results;  ///< all metrics but those of this computer (run/...)
};

struct ComparisonSection {
  std::string title;
  std::vector<RunComparison::Difference> differences;
};

RunComparison compare(const RunReport& a, const RunReport& b);

/// {"a", "b", "configuration": [...], "results": [...]}; a number has its change in percent where that means
/// something.
nlohmann::ordered_json to_json(const RunComparison& comparison);

/// What a person asks: the configuration, what the run is about, then stage by stage and port by port.
std::vector<ComparisonSection> sections(const RunComparison& comparison);

/// These as text. `all`: every metric instead.
std::string to_text(const RunComparison& comparison, bool all);

}  // namespace parallax
