// SPDX-License-Identifier: Apache-2.0
#include "platform/python/process_start.hpp"

#include <cstdlib>
#include <opencv2/core/utility.hpp>

#include "platform/commands/report_handler.hpp"

namespace parallax {

void prepare_process() {
  // OpenCV's threads are not here, and would be waited for.
  cv::setNumThreads(0);
  ::setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 0);
  handle_reports();
}

}  // namespace parallax
