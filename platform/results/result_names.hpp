// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace parallax {

/// What a `parallax run` is going to write beside each other in its folder.
struct ResultPlan {
  bool frames = false;                ///< images are computed
  bool sequence = false;              ///< of several frames: each in a folder of its own
  bool truth = false;                 ///< they are compared with a ground truth
  bool points = false;                ///< a point cloud is made of them
  bool timing = false;                ///< the numbers of one run
  bool sweep = false;                 ///< the numbers of each point of a grid
  bool relaxations = false;           ///< what each limit costs
  bool report = false;                ///< a page of it all
  bool circuits = false;              ///< where circuits in the place of stages differ
  std::vector<std::string> traces{};  ///< formats
};

/// Whether a file of an output folder, by its path in there, has the name of a result of `parallax run`:
/// those of a frame, in a folder frame_0000 or not, of a point of a grid, or of the run. What has such a name
/// and was written by an earlier run gives way to the results of another one, which need not have all of
/// them.
bool is_result_name(const std::string& path);

/// Whether a run of this plan writes a file of this name.
bool is_planned(const ResultPlan& plan, const std::string& path);

}  // namespace parallax
