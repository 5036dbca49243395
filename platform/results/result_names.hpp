// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace parallax {

/// Whether a file of an output folder, by its path in there, has the name of a result of `parallax run`:
/// those of a frame, in a folder frame_0000 or not, of a point of a grid, or of the run. What has such a name
/// gives way to the results of another run, which need not have all of them.
bool is_result_name(const std::string& path);

}  // namespace parallax
