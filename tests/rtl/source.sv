// SPDX-License-Identifier: Apache-2.0
// Writes 0, 1, 2, ... when `want` is up and there is room.
module source #(
    parameter int WIDTH = 8
) (
    input  logic             clk,
    input  logic             want,
    output logic             valid,
    input  logic             ready,
    output logic [WIDTH-1:0] data
);
  initial data = 0;
  assign valid = want;
  always_ff @(posedge clk) if (valid && ready) data <= data + 1;
endmodule
