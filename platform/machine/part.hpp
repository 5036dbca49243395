// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "platform/machine/stage_info.hpp"

namespace parallax {

struct MemoryPort;

/// A limit of a machine that can be taken away (platform/evaluation/relaxation.hpp says how).
enum class Relief {
  kFifos,    ///< between stages
  kMemory,   ///< its bandwidth and latency
  kDma,      ///< bursts under way
  kCamera,   ///< rate, cable, pixel clock, exposure
  kBuffers,  ///< number of frame and output buffers
  kCoreClock,
  kMemoryClock,
  kCameraClock,
  kFrameGap,          ///< between frames, while a stage empties its look-ahead
  kMatchingInterval,  ///< of the matcher, and its recurrence
  kBufferPort,        ///< width of the port to what the matcher keeps in memory
  kPathStorage,       ///< path costs in memory
  kSoftware,          ///< its time between frames
  kLinkClock,
  kLink,  ///< its line rate
  kHost,  ///< its pixel rate
};

/// "core_clock".
const char* name_of(Relief relief);
/// The name of a part or relief in a sentence: "core clock".
std::string spoken(std::string name);

/// What can be at work, and so limit the frame rate.
enum class PartKind {
  kMemory,
  kCamera,
  kCameraRate,  ///< the rate that the cameras are set to: a pace that is given, not work
  kDmaEngine,
  kSoftware,  ///< between a frame that could be started and the core's start
  kCore,      ///< with a frame, or about to be started with one
  kStage,
  kLink,
  kHost,
};

/// A part of a machine that can limit its frame rate. Made where it is wired: by Acquisition, Software,
/// StereoCore, Transmission and MemoryPort, and by Machine for what it holds itself.
struct Part {
  PartKind kind;
  std::string name;                  ///< its id in results: "matching", "dma_left"
  std::string key;                   ///< the configuration keys that make it faster
  std::vector<Relief> relieved_by;   ///< the limits without which it would be faster
  std::optional<StageInfo> stage{};  ///< of a stage
  const MemoryPort* port = nullptr;  ///< of a DMA engine
  bool core_waits = false;           ///< the core may wait for it while it counts as at work
};

}  // namespace parallax
