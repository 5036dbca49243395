// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace parallax {

/// The report of a run, a page of HTML, from the folder of its results: timing.json, and as far as they are
/// there profile.json, relaxations.json and the images (of a sequence, those of the first frame). Throws
/// UserError as read_run_report() does.
std::string report_of(const std::filesystem::path& folder);

}  // namespace parallax
