// SPDX-License-Identifier: Apache-2.0
// Which of the places -REACH..REACH around position `at` of a row or column of SIZE are inside the image.
`timescale 1ns / 1ps
`default_nettype none

module in_image #(
  parameter int SIZE = 640,
  parameter int REACH = 2
) (
  input wire [15:0] at,
  output wire [2*REACH:0] exists
);
  genvar i;
  generate
    for (i = 0; i <= 2 * REACH; i = i + 1) begin : place
      if (i < REACH) begin : lower
        assign exists[i] = at >= 16'(REACH - i);
      end else begin : upper
        assign exists[i] = at < 16'(SIZE + REACH - i);
      end
    end
  endgenerate
endmodule
