// SPDX-License-Identifier: Apache-2.0
// The lowest of N values and the index of the first one that is: a balanced tree.
`timescale 1ns / 1ps
`default_nettype none

module lowest_of #(
  parameter int N = 8,     // 1 to 256
  parameter int BITS = 11
) (
  input wire [N*BITS-1:0] values,
  output wire [BITS-1:0] lowest,
  output wire [7:0] index
);
  generate
    if (N == 1) begin : leaf
      assign lowest = values;
      assign index = 8'd0;
    end else begin : halves
      localparam int LOW = N / 2;
      wire [BITS-1:0] a;
      wire [BITS-1:0] b;
      wire [7:0] a_index;
      wire [7:0] b_index;
      lowest_of #(.N(LOW), .BITS(BITS)) low (.values(values[LOW*BITS-1:0]), .lowest(a), .index(a_index));
      lowest_of #(.N(N - LOW), .BITS(BITS)) high (.values(values[N*BITS-1:LOW*BITS]), .lowest(b), .index(b_index));
      wire takes_b = b < a;
      assign lowest = takes_b ? b : a;
      assign index = takes_b ? b_index + 8'(LOW) : a_index;
    end
  endgenerate
endmodule
