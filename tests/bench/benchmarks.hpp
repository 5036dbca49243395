// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace parallax::bench {

/// How much one benchmark does.
struct Workload {
  std::uint64_t tokens = 1'000'000;  ///< through a chain, rounded up to whole frames of its source
  std::int64_t frames = 4;           ///< of the machine, in the steady state
};

/// Tokens through 8 stages: chain/<mechanism>/<flow>/<depth>.
void register_chain_benchmarks(const Workload& workload);

/// The whole machine without images: machine/<steady or start_up>/<size>_<disparities>.
void register_machine_benchmarks(const Workload& workload);

/// What a trace costs: trace/<level>/<format>.
void register_trace_benchmarks(const Workload& workload);

}  // namespace parallax::bench
