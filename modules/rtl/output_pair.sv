// SPDX-License-Identifier: Apache-2.0
// Two outputs of one stage. TOGETHER: both are written in the first cycle in which both have room, as the model has it
// (tlm/stage.hpp); it is for FIFOs, whose room stays until it is taken: with a receiver that withdraws its ready, an offer
// would be withdrawn too. Otherwise each is taken when it can be, and the stage goes on when both are.
`timescale 1ns / 1ps
`default_nettype none

module output_pair #(
  parameter int TOGETHER = 0
) (
  input wire clk,
  input wire rst,
  input wire valid,
  output wire ready,
  output wire a_valid,
  input wire a_ready,
  output wire b_valid,
  input wire b_ready
);
  generate
    if (TOGETHER != 0) begin : together
      assign ready = a_ready && b_ready;
      assign a_valid = valid && b_ready;
      assign b_valid = valid && a_ready;
    end else begin : apart
      reg a_done = 1'b0;
      reg b_done = 1'b0;
      assign a_valid = valid && !a_done;
      assign b_valid = valid && !b_done;
      assign ready = (a_ready || a_done) && (b_ready || b_done);
      always_ff @(posedge clk) begin
        a_done <= !rst && valid && !ready && (a_done || a_ready);
        b_done <= !rst && valid && !ready && (b_done || b_ready);
      end
    end
  endgenerate
endmodule
