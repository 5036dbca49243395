// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace parallax {

// What a page holds beside its content; the build puts the files in (assets.cmake).
extern const std::string_view kReportStyle;   ///< report.css
extern const std::string_view kReportScript;  ///< report.js
extern const std::string_view kChartLibrary;  ///< Chart.js

}  // namespace parallax
