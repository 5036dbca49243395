// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <systemc>
#include <utility>

#include "tlm/dataflow.hpp"
#include "tlm/ring.hpp"

namespace parallax {

/// How far a writing DMA engine has come, for a reading one that must not overtake it: when each burst was
/// answered, counted from the object's making on. Dates can be known ahead of time. One reader.
class TransferProgress {
 public:
  /// `dataflow` must outlive the object.
  explicit TransferProgress(Dataflow& dataflow) : dataflow_(&dataflow) {}

  /// The next burst is answered at `time`, which may be in the future.
  void answered(const sc_core::sc_time& time) {
    dates_.push_back(time);
    if (waiter_ != nullptr) dataflow_->wake(*std::exchange(waiter_, nullptr));
  }
  /// When `bursts` bursts have been answered, if that is known; when asked for fewer than before, as many as
  /// then.
  std::optional<sc_core::sc_time> reached(std::uint64_t bursts) {
    while (past_ < bursts && !dates_.empty()) {
      latest_ = std::max(latest_, dates_.front());
      dates_.pop_front();
      ++past_;
    }
    return past_ < bursts ? std::nullopt : std::optional(latest_);
  }
  /// Wakes the reader at the next answer.
  void wait(Actor& reader) { waiter_ = &reader; }

 private:
  Dataflow* dataflow_;
  Ring<sc_core::sc_time> dates_;  // of the answers after these
  std::uint64_t past_ = 0;        // answers that were asked for
  sc_core::sc_time latest_;       // of them
  Actor* waiter_ = nullptr;
};

}  // namespace parallax
