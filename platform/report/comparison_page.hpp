// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "platform/report/run_comparison.hpp"
#include "platform/report/run_report.hpp"

namespace parallax {

/// The comparison of two runs as a page of HTML that holds all it needs.
std::string comparison_page(const RunComparison& comparison, const RunReport& a, const RunReport& b);

}  // namespace parallax
