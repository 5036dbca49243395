// SPDX-License-Identifier: Apache-2.0
// A FIFO of the kind that KIND says, for circuits with one clock.
module fifo #(
    parameter int KIND = 0,  // 0 registered, 1 first-word fall-through, 2 block RAM, 3 by the two offsets
    parameter int DEPTH = 2,
    parameter int WRITE_TO_READ = 1,
    parameter int READ_TO_WRITE = 1,
    parameter int WIDTH = 8
) (
    input  logic             clk,
    input  logic             in_valid,
    output logic             in_ready,
    input  logic [WIDTH-1:0] in_data,
    output logic             out_valid,
    input  logic             out_ready,
    output logic [WIDTH-1:0] out_data
);
  if (KIND == 0) begin : registered
    fifo_registered #(.DEPTH(DEPTH), .WIDTH(WIDTH)) is (.*);
  end else if (KIND == 1) begin : first_word_fall_through
    fifo_first_word_fall_through #(.DEPTH(DEPTH), .WIDTH(WIDTH)) is (.*);
  end else if (KIND == 2) begin : block_ram
    fifo_block_ram #(.DEPTH(DEPTH), .WIDTH(WIDTH)) is (.*);
  end else begin : free
    fifo_free #(.DEPTH(DEPTH), .WRITE_TO_READ(WRITE_TO_READ), .READ_TO_WRITE(READ_TO_WRITE), .WIDTH(WIDTH)) is (.*);
  end
endmodule
