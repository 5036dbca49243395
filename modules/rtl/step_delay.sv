// SPDX-License-Identifier: Apache-2.0
// What came in so many steps ago, `current`, and what follows it: in registers for few WORDS, else in a memory with a
// registered read, one step ahead, as a block RAM has it.
`timescale 1ns / 1ps
`default_nettype none

module step_delay #(
  parameter int WORDS = 8,     // at least 1
  parameter int BITS = 72,
  parameter int REGISTERS = 0  // 1: all in registers. 0: in a memory, of at least 3 words
) (
  input wire clk,
  input wire step,
  input wire [BITS-1:0] in,
  output wire [BITS-1:0] current,
  output wire [BITS-1:0] following  // with one word: the same
);
  generate
    if (REGISTERS != 0) begin : registers
      reg [WORDS*BITS-1:0] held;  // the newest lowest
      wire [(WORDS+1)*BITS-1:0] longer = {held, in};
      always_ff @(posedge clk) begin
        if (step) held <= longer[WORDS*BITS-1:0];
      end
      assign current = held[(WORDS-1)*BITS +: BITS];
      assign following = held[(WORDS > 1 ? WORDS-2 : 0)*BITS +: BITS];
    end else begin : memory
      localparam int AT_BITS = $clog2(WORDS);
      reg [BITS-1:0] held [0:WORDS-1];
      reg [BITS-1:0] oldest;
      reg [BITS-1:0] second;  // out of the memory
      reg [AT_BITS-1:0] write_at = AT_BITS'(WORDS - 2);
      reg [AT_BITS-1:0] read_at = '0;  // two steps ahead of it
      always_ff @(posedge clk) begin
        if (step) begin
          held[write_at] <= in;
          second <= held[read_at];
          oldest <= second;
          write_at <= write_at == AT_BITS'(WORDS - 1) ? '0 : write_at + 1'b1;
          read_at <= read_at == AT_BITS'(WORDS - 1) ? '0 : read_at + 1'b1;
        end
      end
      assign current = oldest;
      assign following = second;
    end
  endgenerate
endmodule
