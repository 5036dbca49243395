// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>

#include "tests/bench/chain_load.hpp"
#include "tests/bench/cpu_seconds.hpp"

namespace parallax::bench {

/// The dates as a recurrence in a plain loop, token by token: no kernel, no modules, no statistics, and a
/// chain of this very shape only. What any mechanism that computes a date a token can hope for.
inline ChainRun run_max_plus(const ChainLoad& load) {
  const double began = cpu_seconds();
  std::vector<std::array<std::int64_t, kStages + 1>> reads(
      load.depth);  // of the last `depth` tokens, by FIFO
  for (auto& read : reads) read.fill(-1);
  std::array<std::int64_t, kStages> left{};  // when the token before left each stage
  Gaps source(load.source_gaps);
  Gaps sink(load.sink_gaps);
  std::int64_t source_free = 0;
  std::int64_t sink_free = 0;
  std::int64_t last_read = 0;
  std::size_t slot = 0;
  const std::uint64_t tokens = load.tokens();
  for (std::uint64_t token = 0; token < tokens; ++token) {
    auto& read = reads[slot];
    if (++slot == load.depth) slot = 0;
    std::int64_t date = std::max(source_free, read[0] + 1);
    source_free = date + source.next();
    for (std::size_t stage = 0; stage < kStages; ++stage) {
      read[stage] = std::max(date + 1, left[stage]);
      date = std::max(read[stage], read[stage + 1]) + 1;
      left[stage] = date;
    }
    last_read = std::max(sink_free, date + 1);
    read[kStages] = last_read;
    sink_free = last_read + sink.next();
  }
  return {cpu_seconds() - began, last_read};
}

}  // namespace parallax::bench
