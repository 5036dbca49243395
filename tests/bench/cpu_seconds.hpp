// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ctime>

namespace parallax::bench {

/// Processor time that this process has used, on all its threads. But for traces, what is measured here runs
/// on one and waits for nothing, so this is its wall time on a machine with nothing else to do.
inline double cpu_seconds() {
  std::timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace parallax::bench
