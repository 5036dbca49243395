// SPDX-License-Identifier: Apache-2.0
// A line of values around its middle one, where those outside the image become the nearest inside.
`timescale 1ns / 1ps
`default_nettype none

module nearest_in_image #(
  parameter int REACH = 2,
  parameter int BITS = 8
) (
  input wire [(2*REACH+1)*BITS-1:0] in,
  input wire [2*REACH:0] exists,
  output wire [(2*REACH+1)*BITS-1:0] out
);
  function automatic [(2*REACH+1)*BITS-1:0] filled(input [(2*REACH+1)*BITS-1:0] line, input [2*REACH:0] there);
    begin
      filled = line;
      for (int i = REACH - 1; i >= 0; i = i - 1) begin
        if (!there[i]) filled[i*BITS +: BITS] = filled[(i+1)*BITS +: BITS];
      end
      for (int i = REACH + 1; i <= 2 * REACH; i = i + 1) begin
        if (!there[i]) filled[i*BITS +: BITS] = filled[(i-1)*BITS +: BITS];
      end
    end
  endfunction
  assign out = filled(in, exists);
endmodule
