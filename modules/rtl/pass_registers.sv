// SPDX-License-Identifier: Apache-2.0
// The registers of a pipeline that only hand on, register 0 first; each takes when its moves says so (stage_control.sv).
`timescale 1ns / 1ps
`default_nettype none

module pass_registers #(
  parameter int BITS = 8,
  parameter int STAGES = 1  // 0: none
) (
  input wire clk,
  input wire [(STAGES > 0 ? STAGES-1 : 0):0] moves,
  input wire [BITS-1:0] in,
  output wire [BITS-1:0] out
);
  genvar i;
  generate
    if (STAGES == 0) begin : none
      assign out = in;
    end else begin : some
      reg [STAGES*BITS-1:0] data;  // register 0 lowest
      always_ff @(posedge clk) begin
        if (moves[0]) data[0 +: BITS] <= in;
      end
      for (i = 1; i < STAGES; i = i + 1) begin : place
        always_ff @(posedge clk) begin
          if (moves[i]) data[i*BITS +: BITS] <= data[(i-1)*BITS +: BITS];
        end
      end
      assign out = data[(STAGES-1)*BITS +: BITS];
    end
  endgenerate
endmodule
