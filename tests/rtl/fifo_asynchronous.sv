// SPDX-License-Identifier: Apache-2.0
// FIFO between two clocks. Each side hands its pointer, in Gray code, to the other one through a chain of
// registers there, TO_READER and TO_WRITER long: a pointer launched at an edge is captured at the other clock's
// first edge strictly after it, is at the end of the chain as many edges from there on, and is compared without a
// further register.
//
// Pointers count modulo 2 * DEPTH. For a depth that is no power of two they go round the middle piece of a
// longer Gray code, which is a mirror image of itself, so that the wrap changes one bit only, too.
module fifo_asynchronous #(
    parameter int DEPTH = 2,
    parameter int TO_READER = 2,
    parameter int TO_WRITER = 2,
    parameter int WIDTH = 8
) (
    input  logic             in_clk,
    input  logic             in_valid,
    output logic             in_ready,
    input  logic [WIDTH-1:0] in_data,
    input  logic             out_clk,
    output logic             out_valid,
    input  logic             out_ready,
    output logic [WIDTH-1:0] out_data
);
  localparam int BITS = $clog2(2 * DEPTH);
  localparam int PLACE = DEPTH > 1 ? $clog2(DEPTH) : 1;
  localparam int FIRST = (1 << (BITS - 1)) - DEPTH;
  localparam int LAST = (1 << (BITS - 1)) + DEPTH - 1;
  typedef logic [BITS-1:0] Pointer;

  function automatic Pointer gray(Pointer binary);
    return binary ^ (binary >> 1);
  endfunction
  function automatic Pointer binary(Pointer code);
    binary = code;
    for (int shift = 1; shift < BITS; shift *= 2) binary ^= binary >> shift;
  endfunction
  function automatic Pointer next(Pointer pointer);
    return pointer == Pointer'(LAST) ? Pointer'(FIRST) : pointer + 1;
  endfunction

  logic [WIDTH-1:0] memory[DEPTH];
  logic [PLACE-1:0] tail_place = 0;
  logic [PLACE-1:0] head_place = 0;
  Pointer tail = Pointer'(FIRST);
  Pointer head = Pointer'(FIRST);
  Pointer tail_gray = gray(Pointer'(FIRST));
  Pointer head_gray = gray(Pointer'(FIRST));
  localparam int TAILS = TO_READER * BITS;
  localparam int HEADS = TO_WRITER * BITS;
  logic [TAILS-1:0] tail_seen = {TO_READER{gray(Pointer'(FIRST))}};  // the chains, whose last register is highest
  logic [HEADS-1:0] head_seen = {TO_WRITER{gray(Pointer'(FIRST))}};

  Pointer head_there;
  Pointer held;
  assign head_there = binary(head_seen[HEADS-1-:BITS]);
  assign held = tail >= head_there ? tail - head_there : tail - head_there + Pointer'(2 * DEPTH);
  assign in_ready = held != Pointer'(DEPTH);
  assign out_valid = tail_seen[TAILS-1-:BITS] != head_gray;
  assign out_data = memory[head_place];

  always_ff @(posedge in_clk) begin
    if (in_valid && in_ready) begin
      memory[tail_place] <= in_data;
      tail_place <= tail_place == PLACE'(DEPTH - 1) ? 0 : tail_place + 1;
      tail <= next(tail);
      tail_gray <= gray(next(tail));
    end
    head_seen <= head_seen << BITS | HEADS'(head_gray);
  end

  always_ff @(posedge out_clk) begin
    if (out_valid && out_ready) begin
      head_place <= head_place == PLACE'(DEPTH - 1) ? 0 : head_place + 1;
      head <= next(head);
      head_gray <= gray(next(head));
    end
    tail_seen <= tail_seen << BITS | TAILS'(tail_gray);
  end
endmodule
