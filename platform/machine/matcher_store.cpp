// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/matcher_store.hpp"

#include <algorithm>

#include "modules/matching.hpp"

namespace parallax {
namespace {

std::uint64_t whole_bytes(std::int64_t bits) { return (bits + 7) / 8; }

}  // namespace

bool MatcherStore::keeps_rows() const {
  return std::any_of(rows.passes.begin(), rows.passes.end(),
                     [](const StoreLayout::Pass& pass) { return pass.rows * pass.record_bytes > 0; });
}

bool MatcherStore::keeps_frame() const { return frame.passes.front().record_bytes > 0; }

std::uint64_t MatcherStore::frame_offset() const {
  std::uint64_t largest = 0;
  for (const StoreLayout::Pass& pass : rows.passes) largest = std::max(largest, rows.row_bytes(pass));
  return largest;
}

std::uint64_t MatcherStore::frame_bytes() const {
  return frame.row_bytes(frame.passes.front()) * frame.passes.front().rows;
}

MatcherStore matcher_store(const MachineConfig& config, int width, int height) {
  const MatchingStore bits = Matching(config.matching, width, height, config.census.code_bits()).store();
  StoreLayout layout;
  const auto pixels = static_cast<std::uint64_t>(config.timing.pixels_per_token);
  layout.width = width / pixels;
  layout.word = Bytes(config.dma.buffer.data_bits / 8);
  layout.burst = Bytes(config.dma.buffer.burst_bytes);
  MatcherStore store{layout, layout};
  const std::uint64_t all_rows = height;
  store.rows.passes = {{all_rows - 1, pixels * whole_bytes(bits.first_pass_row)},
                       {all_rows - 1, pixels * whole_bytes(bits.second_pass_row)}};
  store.frame.passes = {{all_rows, pixels * whole_bytes(bits.frame)}};
  return store;
}

}  // namespace parallax
