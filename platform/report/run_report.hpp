// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "traces/metrics.hpp"

namespace parallax {

/// What a run has left behind: its timing.json.
struct RunReport {
  std::string path;  ///< of the file
  MetricGroup metrics;
  nlohmann::ordered_json configuration;  ///< by section and key
};

/// `path`: a folder of results, or the file itself. Throws UserError when there is none, when it is damaged,
/// and when its schema/version is another (result_schema.hpp).
RunReport read_run_report(const std::string& path);

/// Another JSON file of results, such as profile.json; null where there is none. Throws UserError when it is
/// damaged.
nlohmann::ordered_json read_result_json(const std::string& path);

}  // namespace parallax
