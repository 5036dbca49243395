// SPDX-License-Identifier: Apache-2.0
// The parts of a report, each the HTML of one <section>; empty where the run says nothing about it.
#pragma once

#include <string>

#include "traces/report/report_page.hpp"

namespace parallax {

/// What the run was, and what came out, in some figures.
std::string overview(const ReportInput& input);

std::string images_section(const ReportInput& input);
std::string pipeline_section(const ReportInput& input);
std::string stages_section(const ReportInput& input);
std::string fifos_section(const ReportInput& input);
std::string memory_section(const ReportInput& input);
std::string latency_section(const ReportInput& input);
std::string limits_section(const ReportInput& input);
std::string budget_section(const ReportInput& input);
std::string energy_section(const ReportInput& input);
std::string storage_section(const ReportInput& input);
std::string numbers_section(const ReportInput& input);
std::string configuration_section(const ReportInput& input);

}  // namespace parallax
