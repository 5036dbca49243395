// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <systemc>

#include "tests/timing/graph.hpp"
#include "tlm/stream.hpp"

namespace parallax::test {

/// A thread in kernel time that waits and writes (or reads) one token after another.
template <class T>
class GraphThread final : public sc_core::sc_module {
 public:
  GraphThread(const sc_core::sc_module_name& name, const ClockDomain& clock, const GraphNode& node)
      : sc_module(name), clock_(clock), node_(node) {
    SC_HAS_PROCESS(GraphThread);
    if (node.kind == GraphNode::Kind::kSource) {
      out = std::make_unique<StreamOut<T>>("out");
    } else {
      in = std::make_unique<StreamIn<T>>("in");
    }
    SC_THREAD(run);
  }
  std::unique_ptr<StreamIn<T>> in;
  std::unique_ptr<StreamOut<T>> out;

 private:
  void run() {
    Cycles ready(0);
    for (const std::uint32_t stall : node_.stalls) {
      clock_.wait_until(ready + Cycles(stall));
      if (out) {
        for (int i = 0; i < out->size(); ++i) (*out)[i]->wait_writable();
        for (int i = 0; i < out->size(); ++i) (*out)[i]->commit();
      } else {
        (*in)->wait_readable();
        (*in)->release();
      }
      ready = clock_.now() + Cycles(1);
    }
  }
  const ClockDomain& clock_;
  const GraphNode& node_;
};

}  // namespace parallax::test
