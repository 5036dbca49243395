// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "tlm/stage.hpp"

namespace parallax::test {

/// Notes every firing of one stage, those of leaps one by one too: as a text, as far as that is short, and
/// folded into one number.
struct FiringLog final : StageListener {
  explicit FiringLog(Stage& stage) { stage.add_listener(*this); }

  void fired(const Stage&, const FiringDates& firing) override { note(firing); }
  void repeated(const Stage&, const std::vector<FiringDates>& period, Cycles later, Cycles every,
                std::uint64_t times) override {
    for (std::uint64_t i = 0; i < times; ++i) {
      for (FiringDates firing : period) {
        firing.free += later;
        firing.ready += later;
        firing.start += later;
        note(firing);
      }
      later += every;
    }
  }

  std::string text() const { return fmt::format("{} firings, {:016x}: {}\n", sums.firings, folded_, text_); }

  StageStatistics sums;  ///< where the time went, by the firings alone

 private:
  static constexpr std::uint64_t kShort = 5000;

  void note(const FiringDates& firing) {
    ++sums.firings;
    sums.of(firing.input_wait) += firing.ready - firing.free;
    sums.of(firing.room_wait) += firing.start - firing.ready;
    sums.of(firing.work) += Cycles(firing.interval);
    for (const std::int64_t date : {firing.free.count(), firing.ready.count(), firing.start.count()})
      fold(date);
    fold(static_cast<std::int64_t>(firing.work));
    const bool starved = firing.ready > firing.free;
    const bool blocked = firing.start > firing.ready;
    if (starved) fold(static_cast<std::int64_t>(firing.input_wait));
    if (blocked) fold(static_cast<std::int64_t>(firing.room_wait));
    if (sums.firings > kShort) return;
    text_ += fmt::format("{} {} {} +{} {}", firing.free.count(), firing.ready.count(), firing.start.count(),
                         firing.interval, name_of(firing.work));
    if (starved) text_ += fmt::format(" {} {}", name_of(firing.input_wait), name(firing.input));
    if (blocked) text_ += fmt::format(" {} {}", name_of(firing.room_wait), name(firing.room));
    text_ += "; ";
  }
  void fold(std::int64_t value) { folded_ = (folded_ ^ static_cast<std::uint64_t>(value)) * 0x100000001b3u; }
  static const char* name(const StreamBase* stream) { return stream == nullptr ? "-" : stream->basename(); }

  std::uint64_t folded_ = 0xcbf29ce484222325u;  // FNV-1a
  std::string text_;
};

}  // namespace parallax::test
