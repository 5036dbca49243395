/* SPDX-License-Identifier: Apache-2.0 */
/* A stage of the model for a test bench: tokens in, and what the model's kernel makes of them. For SystemVerilog by DPI-C
   (parallax_stage.sv has the imports), and for whatever else calls C. The library starts the program `parallax stage` for
   each handle, which is looked for as PARALLAX in the environment says, else in PATH, and talks with it; nothing of the
   model is linked into the simulator.

   A token is as wide as its port, in words of 32 bits, bit 0 lowest in the first one: svBitVecVal and svLogicVecVal of DPI.
   Ports have the names of the vectors' manifest ("in_left") or of their streams ("left_rectified").

   Calls that can fail give 0 then, and parallax_stage_message() says why; after the first failure a handle does nothing
   more. No function throws. A handle is for one thread at a time. */
#ifndef PARALLAX_STAGE_H
#define PARALLAX_STAGE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Words that parallax_stage.sv has for a token. */
enum { PARALLAX_STAGE_WORDS = 256 };

/* Four states, as svLogicVecVal: a bit of `bval` that is 1 is x or z. */
struct parallax_logic {
  uint32_t aval;
  uint32_t bval;
};

/* The stage by its name in the time table of a run; options as of `parallax stage`, separated by blanks: "--size 64x48
   -s census.window_width=7". A handle also where this fails, but for a lack of memory (null). */
void* parallax_stage_open(const char* stage, const char* options);

/* Why the handle does nothing more, in one line: a fault, or the first difference; "": it works. Valid until the handle's
   next call. */
const char* parallax_stage_message(const void* stage);

/* Bits of a token at a port. */
int parallax_stage_width(void* stage, const char* port);

/* The next token of an input. Bits above its width must be 0. */
int parallax_stage_push(void* stage, const char* port, const uint32_t* token);

/* The model's next token at an output: 1; 0: it is not there yet. Kernels work on rows: what a row makes is there when the
   row is complete. Words up to the port's width are written. */
int parallax_stage_pop(void* stage, const char* port, uint32_t* token);

/* The circuit's next token at an output, which is compared with the model's when both are there: 1 as long as no difference
   is known. Unknown bits are a difference. Bits above its width are not looked at. */
int parallax_stage_check(void* stage, const char* port, const struct parallax_logic* token);

/* Whether all has been equal, and as many tokens have been checked as the model has made, at each output where one was. */
int parallax_stage_finish(void* stage);

/* Ends the handle; null is nothing. */
void parallax_stage_close(void* stage);

#ifdef __cplusplus
}
#endif

#endif
