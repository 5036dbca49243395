/* SPDX-License-Identifier: Apache-2.0 */
/* A circuit that stands in the place of a stage, as a shared library: what `parallax run --circuit` loads. In C, so that
   whatever simulates the circuit can be behind it; parallax_get_circuit() is all that the library exports. */
#ifndef PARALLAX_CIRCUIT_H
#define PARALLAX_CIRCUIT_H

#ifdef __cplusplus
extern "C" {
#endif

enum { PARALLAX_CIRCUIT_VERSION = 1 };

/* A pin of the circuit's top module. Its value lies at `at`, the lowest byte first, in as many bytes as hold `width` bits;
   bits above are 0. Inputs are written, outputs read, between two calls of evaluate(). */
struct parallax_pin {
  const char* name;
  unsigned is_input;
  unsigned width; /* bits, >= 1 */
  void* at;
};

struct parallax_circuit {
  unsigned version; /* PARALLAX_CIRCUIT_VERSION */
  const char* name; /* of its top module, or of its file, for what is said of it */
  /* A circuit of its own, which keeps its state. What has no initial value is random, by the seed. */
  void* (*make)(unsigned seed);
  /* Its pins, which stay where they are until it is destroyed. */
  const struct parallax_pin* (*pins)(void* circuit, unsigned* number);
  /* The outputs follow the inputs; registers do where a clock pin has risen since the last call. */
  void (*evaluate)(void* circuit);
  /* Whether it has asked for the end of the simulation ($finish). */
  int (*finished)(void* circuit);
  /* Runs its final blocks, and frees it. */
  void (*destroy)(void* circuit);
};

const struct parallax_circuit* parallax_get_circuit(void);

#ifdef __cplusplus
}
#endif

#endif
