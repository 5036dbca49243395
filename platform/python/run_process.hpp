// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "platform/evaluation/worker_process.hpp"
#include "platform/input/run_options.hpp"
#include "platform/python/shared_pages.hpp"
#include "platform/scene/stereo_images.hpp"

namespace parallax {

/// What to run.
struct RunRequest {
  std::vector<std::string> words;  ///< behind `parallax run`
  /// Pairs in the place of files, if there are any, of one, three (BGR) or four channels (BGRA).
  std::vector<StereoImages> images;
  bool keep_images = true;  ///< those of the results
};

/// Where the images of a frame lie in the pages of its run; each has `width` * `height` elements, row by row.
struct FramePlanes {
  std::int64_t index = 0;
  int width = 0;                       ///< px
  int height = 0;                      ///< px
  std::size_t disparities = 0;         ///< 16 bits each: 1/16 px, or kInvalidDisparity
  std::size_t causes = 0;              ///< 8 bits each: Cause
  std::size_t left = 0;                ///< 8 bits each: rectified left image
  std::size_t right = 0;               ///< the same of the right image
  std::optional<std::size_t> truth{};  ///< float, px; 0 = unknown
  std::optional<std::size_t> mask{};   ///< 8 bits each: 255 = scored
};

/// What became of a run.
struct RunOutcome {
  int code = 0;        ///< what the program would end with (exit_codes.hpp); not kBadInput, which is thrown
  std::string timing;  ///< timing.json; empty if there is none
  std::string said;    ///< what the program would say on standard error
  std::vector<FramePlanes> frames;
  std::unique_ptr<MappedPages> pages;  ///< null without frames
};

/// A run in a process of its own, which ends with this object.
class RunProcess {
 public:
  /// Throws UserError for words that are refused, std::system_error when there can be no process.
  explicit RunProcess(RunRequest request);

  /// Waits for a tenth of a second, or until a signal arrives; says whether the run is over.
  bool wait();
  /// Once, when it is. Throws UserError for bad input, std::runtime_error for faults of the program or of
  /// this computer.
  RunOutcome outcome();

 private:
  const RunRequest request_;
  const std::shared_ptr<RunOptions> options_;
  SharedPages pages_;
  WorkerProcess process_;
};

}  // namespace parallax
