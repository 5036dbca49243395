// SPDX-License-Identifier: Apache-2.0
// Three values in ascending order, the lowest one lowest: a sorting network of three comparisons. What is not used of it
// costs nothing.
`timescale 1ns / 1ps
`default_nettype none

module sort_three #(
  parameter int BITS = 12
) (
  input wire [3*BITS-1:0] in,
  output wire [3*BITS-1:0] sorted
);
  wire [BITS-1:0] a = in[0 +: BITS];
  wire [BITS-1:0] b = in[BITS +: BITS];
  wire [BITS-1:0] c = in[2*BITS +: BITS];
  wire falls = b < a;
  wire [BITS-1:0] lower = falls ? b : a;
  wire [BITS-1:0] higher = falls ? a : b;
  wire highest = c < higher;  // is that of the first two
  wire [BITS-1:0] other = highest ? c : higher;
  wire swaps = other < lower;
  assign sorted = {highest ? higher : c, swaps ? lower : other, swaps ? other : lower};
endmodule
