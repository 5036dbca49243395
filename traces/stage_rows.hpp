// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "tlm/schedule.hpp"
#include "traces/row_ends.hpp"

namespace parallax {

/// By which of its ports a stage's rows are counted. One that has no port with rows is one row.
struct StagePorts {
  struct RowPort {
    unsigned number = 0;
    std::shared_ptr<const RowEnds> rows;  ///< of one pass of the stage's schedule
  };
  std::optional<RowPort> read;
  std::optional<RowPort> written;
  std::int64_t passes = 1;  ///< of the schedule, for one frame: one for each tile, or one for all
};

/// A row of a stage: the firings of its schedule from `firing` until the next row's.
struct ScheduleRow {
  std::uint64_t firing = 0;
  std::int32_t row = 0;   ///< of the pass: the row that is read, or, when all are, the row that is written
  bool draining = false;  ///< all rows are read
  std::int32_t row_written = -1;  ///< of the pass: the last row of which it writes something; -1: none
};

/// The rows of one pass of a schedule, and how many firings that has.
struct ScheduleRows {
  std::vector<ScheduleRow> rows;
  std::uint64_t firings = 0;
};

/// A row begins with the firing that reads its first token; when all rows are read, with the firing that
/// writes the first token of a row.
ScheduleRows rows_of(const Schedule& schedule, const StagePorts& ports);

}  // namespace parallax
