// SPDX-License-Identifier: Apache-2.0
#include "modules/store_stages.hpp"

#include <algorithm>

namespace parallax {
namespace {

// The firings of one row: a word that neither begins nor ends anything lengthens the one before.
class Firings {
 public:
  void add(bool consume, bool produce) {
    if (!consume && !produce) {
      ++firings_.back().interval;
    } else {
      firings_.push_back(
          {1, 1, static_cast<PortMask>(consume ? 1 : 0), static_cast<PortMask>(produce ? 1 : 0)});
    }
  }
  /// Equal neighbours in one phase.
  std::vector<Phase> phases() const {
    std::vector<Phase> phases;
    for (const Phase& next : firings_) {
      if (!phases.empty() && phases.back().consume == next.consume && phases.back().produce == next.produce &&
          phases.back().interval == next.interval) {
        ++phases.back().count;
      } else {
        phases.push_back(next);
      }
    }
    return phases;
  }

 private:
  std::vector<Phase> firings_;
};

// Words of the row that byte `end` reaches into, counted from the row's begin.
std::uint64_t words_until(const StoreLayout& layout, std::uint64_t end) {
  const auto word = static_cast<std::uint64_t>(layout.word.count());
  return (end + word - 1) / word;
}

std::uint64_t words_per_burst(const StoreLayout& layout) {
  return static_cast<std::uint64_t>(layout.burst.count() / layout.word.count());
}

// A record comes in; the words that it completes go out, the padding with those of the last record.
std::vector<Phase> pack_row(const StoreLayout& layout, const StoreLayout::Pass& pass) {
  const auto word = static_cast<std::uint64_t>(layout.word.count());
  const std::uint64_t per_burst = words_per_burst(layout);
  Firings firings;
  std::uint64_t packed = 0;  // words
  for (std::uint64_t pixel = 1; pixel <= layout.width; ++pixel) {
    const std::uint64_t complete =
        pixel == layout.width ? layout.row_bursts(pass) * per_burst : pixel * pass.record_bytes / word;
    bool first = true;
    do {
      const bool packs = packed < complete;
      if (packs) ++packed;
      firings.add(first, packs && packed % per_burst == 0);
      first = false;
    } while (packed < complete);
  }
  return firings.phases();
}

// Words come in; a record goes out with its last one.
std::vector<Phase> unpack_row(const StoreLayout& layout, const StoreLayout::Pass& pass, bool backwards) {
  const std::uint64_t per_burst = words_per_burst(layout);
  const std::uint64_t bytes = layout.width * pass.record_bytes;
  const std::uint64_t padding = backwards ? layout.row_bytes(pass) - bytes : 0;
  Firings firings;
  std::uint64_t taken = 0;  // words
  for (std::uint64_t pixel = 1; pixel <= layout.width; ++pixel) {
    const std::uint64_t needed = words_until(layout, padding + pixel * pass.record_bytes);
    do {
      const bool takes = taken < needed;
      if (takes) ++taken;
      firings.add(takes && (taken - 1) % per_burst == 0, taken == needed);
    } while (taken < needed);
  }
  return firings.phases();
}

template <class Row>
Schedule rows(const StoreLayout& layout, Row row) {
  Schedule schedule;
  for (const StoreLayout::Pass& pass : layout.passes) {
    if (pass.record_bytes > 0) schedule.repeat(pass.rows, row(pass));
  }
  return schedule;
}

}  // namespace

StorePackStage::StorePackStage(const sc_core::sc_module_name& name, const StoreLayout& layout,
                               const ClockDomain& clock, Dataflow& dataflow)
    : Stage(name, clock, dataflow, 0) {
  set_schedule(rows(layout, [&](const StoreLayout::Pass& pass) { return pack_row(layout, pass); }));
}

StoreUnpackStage::StoreUnpackStage(const sc_core::sc_module_name& name, const StoreLayout& layout,
                                   bool backwards, const ClockDomain& clock, Dataflow& dataflow)
    : Stage(name, clock, dataflow, 0) {
  set_schedule(
      rows(layout, [&](const StoreLayout::Pass& pass) { return unpack_row(layout, pass, backwards); }));
}

}  // namespace parallax
