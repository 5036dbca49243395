// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tlm/units.hpp"

namespace parallax {

class Stage;
class StreamBase;

/// What a stage's cycles go into.
enum class StageActivity : std::uint8_t {
  kBusy,          ///< firing
  kStarved,       ///< held back by an empty input
  kBlocked,       ///< held back by a full output
  kMemory,        ///< held back by a stream from or to a memory port, within a frame
  kSynchroniser,  ///< held back by a token or a slot that is there, but still on its way between clocks
  kBlanking,      ///< declared row and frame overheads; in a stage that reads from the memory also waiting
                  ///< for a frame's first token, which elsewhere is starving
};
constexpr std::array<StageActivity, 6> kAllStageActivities{
    StageActivity::kBusy,   StageActivity::kStarved,      StageActivity::kBlocked,
    StageActivity::kMemory, StageActivity::kSynchroniser, StageActivity::kBlanking};

/// "busy", "starved", "blocked", "memory", "synchroniser", "blanking".
const char* name_of(StageActivity activity);

/// Where a stage's time went, in cycles of its clock. The six are exact and complete: their sum is the date
/// up to which they are known.
struct StageStatistics {
  std::uint64_t firings = 0;
  Cycles busy;
  Cycles starved;
  Cycles blocked;
  Cycles memory;
  Cycles synchroniser;
  Cycles blanking;

  Cycles total() const { return busy + starved + blocked + memory + synchroniser + blanking; }
  Cycles& of(StageActivity activity) { return this->*kParts[index_of(activity)]; }
  Cycles of(StageActivity activity) const { return this->*kParts[index_of(activity)]; }
  StageStatistics& operator-=(const StageStatistics& o) { return add(o, -1); }
  /// Adds `times` times the other's counts.
  StageStatistics& add(const StageStatistics& o, std::int64_t times);

 private:
  static const std::array<Cycles StageStatistics::*, kAllStageActivities.size()> kParts;  // by activity
};
inline constexpr std::array<Cycles StageStatistics::*, kAllStageActivities.size()> StageStatistics::kParts{
    &StageStatistics::busy,   &StageStatistics::starved,      &StageStatistics::blocked,
    &StageStatistics::memory, &StageStatistics::synchroniser, &StageStatistics::blanking};

/// One firing of a stage, in cycles of its clock: what it had to wait for, one after the other.
struct FiringDates {
  Cycles free;                                         ///< the stage was ready for it
  Cycles ready;                                        ///< its inputs were there
  Cycles start;                                        ///< there was room for what it writes
  std::uint32_t interval = 1;                          ///< how long it keeps the stage busy
  StageActivity work = StageActivity::kBusy;           ///< or kBlanking: a declared overhead
  StageActivity input_wait = StageActivity::kStarved;  ///< what free to ready counts as
  StageActivity room_wait = StageActivity::kBlocked;   ///< what ready to start counts as
  const StreamBase* input = nullptr;                   ///< the input that came last, if there is one
  const StreamBase* room = nullptr;                    ///< the output that had room last, where that is known
};

/// Notified of the firings of a stage, in their order, as soon as their dates are known.
class StageListener {
 public:
  virtual ~StageListener() = default;
  virtual void fired(const Stage& stage, const FiringDates& firing) = 0;
  /// The firings `period` again, `times` times: the first time `later` cycles later, each further time
  /// `every` cycles after the one before. May come later than their dates are known, see patience(). What one
  /// listener gets in one call may be several calls for another.
  virtual void repeated(const Stage& stage, const std::vector<FiringDates>& period, Cycles later,
                        Cycles every, std::uint64_t times) = 0;
  /// With fewer firings than these repeated() may wait for more of the same.
  std::uint64_t patience() const { return patience_; }

 protected:
  void set_patience(std::uint64_t firings) { patience_ = firings; }

 private:
  std::uint64_t patience_ = 0;
};

}  // namespace parallax
