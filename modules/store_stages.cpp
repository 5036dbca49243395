// SPDX-License-Identifier: Apache-2.0
#include "modules/store_stages.hpp"

#include <algorithm>

namespace parallax {
namespace {

// A word of a row. One that neither begins nor ends anything lengthens the firing before.
void add_word(Firings& firings, bool reads, bool writes) {
  if (reads || writes) {
    firings.add(fires().reads(reads ? 1 : 0).writes(writes ? 1 : 0));
  } else {
    firings.lengthen(1);
  }
}

// Words of the row that byte `end` reaches into, counted from the row's begin.
std::uint64_t words_until(const StoreLayout& layout, std::uint64_t end) {
  const std::uint64_t word = layout.word.count();
  return (end + word - 1) / word;
}

std::uint64_t words_per_burst(const StoreLayout& layout) {
  return layout.burst.count() / layout.word.count();
}

// A record comes in; the words that it completes go out, the padding with those of the last record.
std::vector<Phase> pack_row(const StoreLayout& layout, const StoreLayout::Pass& pass) {
  const std::uint64_t word = layout.word.count();
  const std::uint64_t per_burst = words_per_burst(layout);
  Firings firings;
  std::uint64_t packed = 0;  // words
  for (std::uint64_t token = 1; token <= layout.width; ++token) {
    const std::uint64_t complete =
        token == layout.width ? layout.row_bursts(pass) * per_burst : token * pass.record_bytes / word;
    bool first = true;
    do {
      const bool packs = packed < complete;
      if (packs) ++packed;
      add_word(firings, first, packs && packed % per_burst == 0);
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
  for (std::uint64_t token = 1; token <= layout.width; ++token) {
    const std::uint64_t needed = words_until(layout, padding + token * pass.record_bytes);
    do {
      const bool takes = taken < needed;
      if (takes) ++taken;
      add_word(firings, takes && (taken - 1) % per_burst == 0, taken == needed);
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

// Makes rows of the bursts that come in, pass by pass.
class RowsOfBursts {
 public:
  RowsOfBursts(const StoreLayout& layout, bool backwards) : layout_(layout), backwards_(backwards) {
    skip_empty();
  }

  template <class Send>
  void take(const std::uint8_t* burst, std::size_t size, const Send& send) {
    const StoreLayout::Pass& pass = layout_.passes[pass_];
    const std::size_t row_bytes = layout_.row_bytes(pass);
    bytes_.resize(row_bytes);
    const std::size_t at = backwards_ ? row_bytes - filled_ - size : filled_;
    std::copy(burst, burst + size, bytes_.begin() + at);
    filled_ += size;
    if (filled_ < row_bytes) return;
    send(bytes_.data(), layout_.width * pass.record_bytes);
    filled_ = 0;
    ++row_;
    skip_empty();
  }

 private:
  void skip_empty() {
    const auto over = [this] {
      const StoreLayout::Pass& pass = layout_.passes[pass_];
      return pass.record_bytes == 0 || row_ == pass.rows;
    };
    for (std::size_t passes = layout_.passes.size(); passes > 0 && over(); --passes) {
      pass_ = (pass_ + 1) % layout_.passes.size();
      row_ = 0;
    }
  }

  StoreLayout layout_;
  bool backwards_;
  std::size_t pass_ = 0;
  std::uint64_t row_ = 0;            // of it
  std::vector<std::uint8_t> bytes_;  // of that, as they lie in memory
  std::size_t filled_ = 0;           // of these
};

}  // namespace

StorePackStage::StorePackStage(const sc_core::sc_module_name& name, const StoreLayout& layout,
                               const ClockDomain& clock, Dataflow& dataflow)
    : Stage(name, clock, dataflow, 0) {
  set_schedule(rows(layout, [&](const StoreLayout::Pass& pass) { return pack_row(layout, pass); }));
  in_records.on_row(0, [this, burst = static_cast<std::size_t>(layout.burst.count())](const std::uint8_t* row,
                                                                                      std::size_t size) {
    std::vector<std::uint8_t> padded(row, row + size);
    padded.resize((size + burst - 1) / burst * burst);
    out_bursts.send_row(padded.data(), padded.size());
  });
}

StoreUnpackStage::StoreUnpackStage(const sc_core::sc_module_name& name, const StoreLayout& layout,
                                   bool backwards, const ClockDomain& clock, Dataflow& dataflow)
    : Stage(name, clock, dataflow, 0) {
  set_schedule(
      rows(layout, [&](const StoreLayout::Pass& pass) { return unpack_row(layout, pass, backwards); }));
  in_bursts.on_row(
      0, [this, all = RowsOfBursts(layout, backwards)](const std::uint8_t* burst, std::size_t size) mutable {
        all.take(burst, size,
                 [this](const std::uint8_t* row, std::size_t bytes) { out_records.send_row(row, bytes); });
      });
}

}  // namespace parallax
