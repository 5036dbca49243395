// SPDX-License-Identifier: Apache-2.0
// A circuit that Verilator has made C++ of, as parallax_get_circuit(). Included by a file that Parallax
// writes for each one, behind circuit.h: PARALLAX_TOP is its class, PARALLAX_NAME its module,
// PARALLAX_PINS(TOP) its pins.
#include <verilated.h>

#include <cstdio>

namespace {

// What a reset forgets shows: no register begins as 0 unless it is told so. It does when the top is made.
struct RandomContext : VerilatedContext {
  explicit RandomContext(unsigned seed) {
    randReset(2);
    randSeed(static_cast<int>(seed | 1u));
  }
};

// Verilator goes on where its function for fatal errors returns: for ever, in a loop that does not settle.
struct FatalError {};

struct Circuit {
  explicit Circuit(unsigned seed) : context(seed) {}
  void evaluate() {
    if (failed) return;
    try {
      top.eval();
    } catch (const FatalError&) {
      failed = true;
    }
  }
  ~Circuit() {
    if (!failed) top.final();
  }

  RandomContext context;
  bool failed = false;
  PARALLAX_TOP top{&context, PARALLAX_NAME};
  const parallax_pin pins[PARALLAX_PIN_COUNT] = {PARALLAX_PINS(top)};
};

Circuit& of(void* circuit) { return *static_cast<Circuit*>(circuit); }

const parallax_circuit kCircuit{
    PARALLAX_CIRCUIT_VERSION,
    PARALLAX_NAME,
    [](unsigned seed) -> void* { return new Circuit(seed); },
    [](void* circuit, unsigned* number) -> const parallax_pin* {
      *number = PARALLAX_PIN_COUNT;
      return of(circuit).pins;
    },
    [](void* circuit) { of(circuit).evaluate(); },
    [](void* circuit) -> int { return of(circuit).failed || of(circuit).context.gotFinish(); },
    [](void* circuit) { delete &of(circuit); },
};

}  // namespace

// The process belongs to the program that has loaded the circuit, which ends by itself: $finish, $stop and
// fatal errors of the circuit are told by finished().
void vl_finish(const char*, int, const char*) { Verilated::threadContextp()->gotFinish(true); }
void vl_stop(const char* file, int line, const char*) {
  std::fprintf(stderr, "%s:%d: $stop\n", file, line);
  Verilated::threadContextp()->gotFinish(true);
}
void vl_fatal(const char* file, int line, const char*, const char* message) {
  std::fprintf(stderr, "%s:%d: %s\n", file, line, message);
  throw FatalError{};
}

extern "C" __attribute__((visibility("default"))) const parallax_circuit* parallax_get_circuit() {
  return &kCircuit;
}
