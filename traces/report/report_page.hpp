// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "traces/metrics.hpp"

namespace parallax {

struct ReportImage {
  std::string title;
  std::string caption;
  std::string type;                  ///< "image/png"
  std::vector<unsigned char> bytes;  ///< of the file
};

/// A published figure beside what this run reaches.
struct BudgetLine {
  std::string name;
  std::string source;
  std::string metric;
  std::string unit;
  double published = 0;
  std::optional<double> reached{};  ///< none: this run does not say, it is of another size or range
  double deviation = 0;             ///< of `reached`, percent of what was published
  bool within = false;              ///< the deviation is one that the row allows
};

/// What a report is made of.
struct ReportInput {
  MetricGroup metrics;                   ///< of timing.json
  nlohmann::ordered_json configuration;  ///< of timing.json
  nlohmann::ordered_json profile;        ///< profile.json; null: there is none
  nlohmann::ordered_json relaxations;    ///< relaxations.json; null: there is none
  std::vector<ReportImage> images;
  std::vector<BudgetLine> budget;
};

/// A page of HTML that holds all it needs: styles, charts, images, numbers. Its tables say everything without
/// a script. Throws MetricError or nlohmann's exceptions where a number is missing or of another kind.
std::string report_page(const ReportInput& input);

/// Another page in the same clothes: `body` is HTML, `data` what report.js reads.
std::string html_page(const std::string& title, const std::string& body, const nlohmann::ordered_json& data);

}  // namespace parallax
