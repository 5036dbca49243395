// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/verilated_chain.hpp"

#include <stdexcept>

#include "Chain8Depth16.h"
#include "Chain8Depth2.h"
#include "Chain8Depth64.h"
#include "tests/bench/cpu_seconds.hpp"

namespace parallax::bench {
namespace {

template <class Chain>
ChainRun run(const ChainLoad& load) {
  VerilatedContext context;
  Chain chain(&context);
  Gaps source(load.source_gaps);
  Gaps sink(load.sink_gaps);
  const std::uint64_t tokens = load.tokens();
  std::uint64_t written = 0;
  std::uint64_t read = 0;
  std::int64_t source_free = 0;
  std::int64_t sink_free = 0;
  std::int64_t last_read = 0;
  const double began = cpu_seconds();
  for (std::int64_t cycle = 0; read < tokens; ++cycle) {
    chain.want_write = written < tokens && cycle >= source_free;
    chain.want_read = cycle >= sink_free;
    chain.clk = 0;
    chain.eval();
    if (chain.wrote) {
      ++written;
      source_free = cycle + source.next();
    }
    if (chain.was_read) {
      ++read;
      last_read = cycle;
      sink_free = cycle + sink.next();
    }
    chain.clk = 1;
    chain.eval();
    if (chain.disorder) throw std::runtime_error("the circuit has lost or overtaken a token");
  }
  return {cpu_seconds() - began, last_read};
}

}  // namespace

ChainRun run_verilated(const ChainLoad& load) {
  switch (load.depth) {
    case 2:
      return run<Chain8Depth2>(load);
    case 16:
      return run<Chain8Depth16>(load);
    case 64:
      return run<Chain8Depth64>(load);
    default:
      throw std::runtime_error("no circuit of this depth");
  }
}

}  // namespace parallax::bench
