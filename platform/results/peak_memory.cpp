// SPDX-License-Identifier: Apache-2.0
#include "platform/results/peak_memory.hpp"

#include <sys/resource.h>

#include <fstream>
#include <string>

namespace parallax {

double peak_memory_megabytes() {
  constexpr double kKibibytes = 1024.0;
  // Not from getrusage alone: its figure includes whoever started the program, before it became this one.
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kibibytes = 0;
    if (word == "VmHWM:" && status >> kibibytes) return kibibytes / kKibibytes;
  }
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / kKibibytes;
}

}  // namespace parallax
