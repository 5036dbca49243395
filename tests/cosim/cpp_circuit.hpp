// SPDX-License-Identifier: Apache-2.0
// A circuit in C++ as parallax_get_circuit(), which is compiled in a second where one of Verilator takes
// ten. Included by the source that make_cpp_circuit() writes, behind PINS(IN, OUT), a list of IN(name, bits)
// and OUT(name, bits): each pin is a number of that name. The source defines evaluate(rises): outputs follow
// inputs, behind a rising edge of the pin clk if there is one. There is one circuit of it in a process.
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "circuit.h"

#define NUMBER(name, bits) static std::uint64_t name;
PINS(NUMBER, NUMBER)
#undef NUMBER
static bool ended = false;  // as by $finish
static void evaluate(bool rises);

#define INPUT(name, bits) {#name, 1, bits, &(name)},
#define OUTPUT(name, bits) {#name, 0, bits, &(name)},
static const parallax_pin kPins[] = {PINS(INPUT, OUTPUT)};
#undef INPUT
#undef OUTPUT

static void* made(unsigned) { return &ended; }

static const parallax_pin* pins(void*, unsigned* number) {
  *number = sizeof kPins / sizeof kPins[0];
  return kPins;
}

static void follow(void*) {
  static std::uint64_t before = 0;
  std::uint64_t now = 0;
  for (const parallax_pin& pin : kPins) {
    if (std::strcmp(pin.name, "clk") == 0) std::memcpy(&now, pin.at, sizeof now);
  }
  const bool rises = now == 1 && before == 0;
  before = now;
  evaluate(rises);
}

static int has_ended(void*) { return ended ? 1 : 0; }

static void gone(void*) {}

#ifndef VERSION
#define VERSION PARALLAX_CIRCUIT_VERSION
#endif
static const parallax_circuit kCircuit{VERSION, "circuit", made, pins, follow, has_ended, gone};

extern "C" const parallax_circuit* parallax_get_circuit() { return &kCircuit; }
