// SPDX-License-Identifier: Apache-2.0
// What a trace tells: the parts of a machine, and what happened to them when. Dates are in picoseconds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tlm/stage_activity.hpp"
#include "tlm/units.hpp"

namespace parallax {

/// Number of a part in TraceParts; kNoPart: none, or none that is known.
using PartId = std::int32_t;
constexpr PartId kNoPart = -1;

/// Where in the stream of frames something is.
struct TracePosition {
  std::int64_t frame = -1;  ///< from 0; -1: before the first one
  std::int32_t tile = 0;    ///< from 0, of an image that is processed in tiles
  std::int32_t row = -1;    ///< from 0, of the tile's image; -1: none
};

/// The parts that events name by their number.
struct TraceParts {
  struct StagePart {
    std::string name;  ///< "matching"
    std::string path;  ///< "machine.core.pipeline.matching"
  };
  struct StreamPart {
    std::string name;
    std::string path;
    std::uint32_t depth = 0;     ///< tokens
    std::int64_t width = 0;      ///< bit
    Picoseconds write_cycle;     ///< of the writer's clock, rounded down
    Picoseconds read_cycle;      ///< of the reader's clock, rounded down
    std::string writer, reader;  ///< names of the stages or engines at its ends
  };
  struct PortPart {
    std::string name;
    std::string path;
  };
  std::vector<StagePart> stages;
  std::vector<StreamPart> streams;
  std::vector<PortPart> ports;
  std::int32_t rows = 0;    ///< of the image
  std::int32_t tiles = 1;   ///< that a frame consists of
  std::int64_t frames = 0;  ///< that the run consists of
  bool tokens = false;      ///< whether every token is told of, not rows alone
};

/// A stage begins with a row: its first firing.
struct RowBegin {
  PartId stage = kNoPart;
  TracePosition position;  ///< row: the row that it reads, or, when it is draining, the row that it writes
  bool draining = false;   ///< all rows are read, those held back come out
  std::int32_t row_written = -1;  ///< the last row of which it writes something in it; -1: none
  Picoseconds begin;
};

/// A stage at work on a row: from the row's first firing until that of the row after.
struct StageRow : RowBegin {
  Picoseconds busy_until;    ///< the row's last firing is over; from here on the stage waits
  Picoseconds inputs_until;  ///< the inputs of the next firing are there; from here on it waits for room
  Picoseconds end;
  StageStatistics time;                                ///< where the cycles from begin to end went
  StageActivity input_wait = StageActivity::kStarved;  ///< busy_until to inputs_until
  PartId input = kNoPart;                              ///< the stream it waited for, if known
  StageActivity room_wait = StageActivity::kBlocked;   ///< inputs_until to end
  PartId room = kNoPart;
  /// The kind of wait at one stream that was longest, summed over the row; kBusy: there was no wait.
  StageActivity longest_wait = StageActivity::kBusy;
  PartId longest_at = kNoPart;  ///< that stream
};

/// One firing of a stage.
struct StageFiring {
  PartId stage = kNoPart;
  TracePosition position;
  Picoseconds free;   ///< ready for it, from here on it waits for inputs
  Picoseconds ready;  ///< from here on it waits for room
  Picoseconds start;
  Picoseconds end;
  StageActivity work = StageActivity::kBusy;
  StageActivity input_wait = StageActivity::kStarved;
  StageActivity room_wait = StageActivity::kBlocked;
  PartId input = kNoPart;
  PartId room = kNoPart;
};

/// What a FIFO held from one date to another.
struct FifoSpan {
  PartId stream = kNoPart;
  Picoseconds begin;
  Picoseconds end;
  std::uint64_t cycles = 0;        ///< of the writer's clock
  std::uint64_t token_cycles = 0;  ///< tokens held, summed over the cycles
  std::uint64_t full_cycles = 0;
  std::uint64_t empty_cycles = 0;
  std::uint64_t written = 0;  ///< tokens in it
  std::uint64_t freed = 0;    ///< slots in it
  std::uint64_t level = 0;    ///< tokens held at the end

  double mean() const { return quotient(token_cycles, cycles); }
};

/// A token that is written to a stream or read from it, in the cycle that begins at `begin`.
struct TokenTransfer {
  PartId stream = kNoPart;
  bool read = false;
  TracePosition position;
  Picoseconds begin;
  Picoseconds end;          ///< of the cycle
  std::uint64_t level = 0;  ///< tokens held after it
};

/// The bytes of a row through a memory port: from its first request, or the last answer to the row before,
/// until its last answer.
struct PortRow {
  PartId port = kNoPart;
  TracePosition position;
  Picoseconds begin;
  Picoseconds end;
  std::uint64_t bytes = 0;
  std::uint64_t bursts = 0;
  Picoseconds latency;  ///< summed over the bursts
  Picoseconds longest_latency;
};

/// A memory port has asked for a burst, or got its answer.
struct PortRequests {
  PartId port = kNoPart;
  Picoseconds time;
  std::int64_t under_way = 0;  ///< bursts from here on
};

/// A burst through a memory port.
struct BurstTransfer {
  PartId port = kNoPart;
  TracePosition position;
  bool write = false;
  std::uint64_t address = 0;
  std::uint64_t bytes = 0;
  Picoseconds requested;
  Picoseconds answered;
};

/// What a frame comes to, in this order but for kInMemory.
enum class FrameStep : std::uint8_t {
  kExposed,         ///< end of exposure, the read-out begins
  kFirstByte,       ///< in memory
  kStartable,       ///< as much of it in memory as the core waits for
  kInMemory,        ///< all of it; in a machine that starts early this may come after other steps
  kCoreStarted,     ///< by software
  kFirstDisparity,  ///< out of the last filter
  kLastDisparity,
  kResultsInMemory,
  kAtHost,  ///< its last bit
};
constexpr std::size_t kFrameSteps = 9;
/// "exposed", "first_byte", "startable", "in_memory", "core_started", "first_disparity", "last_disparity",
/// "results_in_memory", "at_host".
const char* name_of(FrameStep step);

/// When one frame came to its steps.
struct FrameRecord {
  std::int64_t frame = 0;
  Picoseconds at[kFrameSteps];
};

/// A stage or engine that waits for ever, in a machine that is stuck.
struct EndlessWait {
  std::string waiter;
  std::string stream;
  bool on_full = false;
  std::uint32_t depth = 0;
};

}  // namespace parallax
