// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/part.hpp"

#include <algorithm>

namespace parallax {

const char* name_of(Relief relief) {
  switch (relief) {
    case Relief::kFifos:
      return "fifos";
    case Relief::kMemory:
      return "memory";
    case Relief::kDma:
      return "dma";
    case Relief::kCamera:
      return "camera";
    case Relief::kBuffers:
      return "buffers";
    case Relief::kCoreClock:
      return "core_clock";
    case Relief::kMemoryClock:
      return "memory_clock";
    case Relief::kCameraClock:
      return "camera_clock";
    case Relief::kFrameGap:
      return "frame_gap";
    case Relief::kMatchingInterval:
      return "matching_interval";
    case Relief::kBufferPort:
      return "buffer_port";
    case Relief::kPathStorage:
      return "path_storage";
    case Relief::kSoftware:
      return "software";
    case Relief::kLinkClock:
      return "link_clock";
    case Relief::kLink:
      return "link";
    case Relief::kHost:
      return "host";
  }
  return "";
}

std::string spoken(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

}  // namespace parallax
