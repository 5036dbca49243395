// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <memory>
#include <systemc>

#include "tests/bench/chain_load.hpp"
#include "tests/bench/cpu_seconds.hpp"
#include "tests/tlm/thread.hpp"

namespace parallax::bench {

/// The plain way in SystemC: a thread a stage, an sc_fifo between two, and a wait in the kernel for every
/// token.
///
/// Its dates are not the hardware's. What is written can be read in the same cycle, and a slot is free in
/// the cycle in which it is read, as no register allows it.
inline ChainRun run_sc_fifo(const ChainLoad& load) {
  const sc_core::sc_time cycle(1, sc_core::SC_NS);
  const std::uint64_t tokens = load.tokens();
  std::vector<std::unique_ptr<sc_core::sc_fifo<int>>> fifos;
  for (int i = 0; i <= kStages; ++i) {
    fifos.push_back(
        std::make_unique<sc_core::sc_fifo<int>>(fmt::format("f{}", i).c_str(), static_cast<int>(load.depth)));
  }
  const test::Thread source("source", [&] {
    Gaps gaps(load.source_gaps);
    for (std::uint64_t token = 0; token < tokens; ++token) {
      fifos.front()->write(1);
      sc_core::wait(cycle * static_cast<double>(gaps.next()));
    }
  });
  std::vector<std::unique_ptr<test::Thread>> stages;
  for (std::size_t stage = 0; stage < kStages; ++stage) {
    stages.push_back(std::make_unique<test::Thread>(fmt::format("n{}", stage).c_str(), [&, stage] {
      for (;;) {
        const int value = fifos[stage]->read();
        sc_core::wait(cycle);
        fifos[stage + 1]->write(value);
      }
    }));
  }
  sc_core::sc_time last_read;
  const test::Thread sink("sink", [&] {
    Gaps gaps(load.sink_gaps);
    for (std::uint64_t token = 0; token < tokens; ++token) {
      fifos.back()->read();
      last_read = sc_core::sc_time_stamp();
      sc_core::wait(cycle * static_cast<double>(gaps.next()));
    }
  });

  const double began = cpu_seconds();
  sc_core::sc_start();
  const double seconds = cpu_seconds() - began;
  return {seconds, static_cast<std::int64_t>(last_read / cycle)};
}

}  // namespace parallax::bench
