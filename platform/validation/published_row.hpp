// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace parallax {

/// One published figure and what the model has to do to predict it.
struct PublishedRow {
  std::string origin;  ///< "file:line"
  std::string name;
  std::string source;                    ///< where it was published
  std::string preset;                    ///< empty: that of the file
  std::vector<std::string> assignments;  ///< "key=value"
  int width = 0;                         ///< px
  int height = 0;                        ///< px
  bool rectified = false;  ///< the images come rectified: an identity map; else the built-in scene's lens
  bool refused = false;    ///< the machine must refuse this; the rest is unused
  std::string metric;      ///< a path in timing.json, or "frame_time": ms from frame to frame
  std::string unit;
  double published = 0;
  double least = 0;  ///< percent by which the prediction may deviate, at least
  double most = 0;   ///< and at most

  /// Percent by which a prediction differs from what was published, and whether it may.
  double deviation(double predicted) const { return 100 * (predicted / published - 1); }
  bool allows(double deviation) const { return deviation >= least && deviation <= most; }
};

/// Published figures of one or several machines.
struct PublishedRows {
  std::string description;
  std::string preset;  ///< of the rows that name none
  std::vector<PublishedRow> rows;
};

/// Names of the files of rows that come with the program.
std::vector<std::string> published_row_files();

/// Reads a file of rows, by name from `validation/<name>.toml` in the preset folders, or by path. Throws
/// UserError with file and line.
PublishedRows read_published_rows(const std::string& name,
                                  const std::vector<std::filesystem::path>& preset_folders);

}  // namespace parallax
