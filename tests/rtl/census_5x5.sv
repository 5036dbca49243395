// SPDX-License-Identifier: Apache-2.0
// The census stage from its definition (modules/census.hpp) with the ports of its test bench: it keeps whole images, so that
// nothing of the model's way to do it is in it. FAULT_*: what one gets wrong in such a circuit.
`timescale 1ns / 1ps
`default_nettype none

module census_5x5 #(
  parameter WIDTH = 64,
  parameter HEIGHT = 48
) (
  input wire clk,
  input wire rst,
  input wire [7:0] in_left_data,
  input wire in_left_valid,
  input wire in_left_first,
  input wire in_left_last,
  output wire in_left_ready,
  input wire [7:0] in_right_data,
  input wire in_right_valid,
  input wire in_right_first,
  input wire in_right_last,
  output wire in_right_ready,
  output reg [23:0] out_left_data,
  output reg out_left_valid,
  input wire out_left_ready,
  output reg [23:0] out_right_data,
  output reg out_right_valid,
  input wire out_right_ready
);
  localparam PIXELS = WIDTH * HEIGHT;
  reg [7:0] left [0:PIXELS - 1];
  reg [7:0] right [0:PIXELS - 1];
  integer taken;    // pixels of the frame that have come
  integer written;  // codes that have been offered

  wire both_free = (!out_left_valid || out_left_ready) && (!out_right_valid || out_right_ready);
  wire take = in_left_valid && in_right_valid && taken < PIXELS;
  assign in_left_ready = take;
  assign in_right_ready = take;

  integer x, y, u, v, cu, cv;
  reg [23:0] left_code, right_code;
  reg [7:0] left_centre, right_centre, left_pixel, right_pixel;

  always @(posedge clk) begin
    if (rst) begin
      taken <= 0;
      written <= 0;
      out_left_valid <= 1'b0;
      out_right_valid <= 1'b0;
    end else begin
`ifdef FAULT_HANGS
      if (take && !(taken == 1000)) begin
`else
      if (take) begin
`endif
        left[taken] <= in_left_data;
        right[taken] <= in_right_data;
        taken <= taken + 1;
      end
      if (out_left_ready) out_left_valid <= 1'b0;
      if (out_right_ready) out_right_valid <= 1'b0;
      if (both_free && written < PIXELS && (taken == PIXELS || taken > written + 2 * WIDTH + 2)) begin
        x = written % WIDTH;
        y = written / WIDTH;
        left_code = 24'd0;
        right_code = 24'd0;
        left_centre = left[written];
        right_centre = right[written];
        for (v = y - 2; v <= y + 2; v = v + 1) begin
          for (u = x - 2; u <= x + 2; u = u + 1) begin
            if (u != x || v != y) begin
              cu = u < 0 ? 0 : u >= WIDTH ? WIDTH - 1 : u;
              cv = v < 0 ? 0 : v >= HEIGHT ? HEIGHT - 1 : v;
              left_pixel = left[cv * WIDTH + cu];
              right_pixel = right[cv * WIDTH + cu];
`ifdef FAULT_BORDER
              if (u < 0 || v < 0 || u >= WIDTH || v >= HEIGHT) left_pixel = 8'd0;
`endif
`ifdef FAULT_COMPARISON
              left_code = {left_code[22:0], left_pixel > left_centre};
`else
`ifdef FAULT_ORDER
              left_code = {left_pixel < left_centre, left_code[23:1]};
`else
              left_code = {left_code[22:0], left_pixel < left_centre};
`endif
`endif
              right_code = {right_code[22:0], right_pixel < right_centre};
            end
          end
        end
        out_left_data <= left_code;
        out_right_data <= right_code;
`ifdef FAULT_LOST
        out_left_valid <= written != 640;
`else
        out_left_valid <= 1'b1;
`endif
        out_right_valid <= 1'b1;
        if (written + 1 == PIXELS) begin
          written <= 0;
          taken <= 0;
        end else begin
          written <= written + 1;
        end
      end
`ifdef FAULT_CHANGED
      else if (written == 640 && out_left_valid && !out_left_ready) out_left_data <= ~out_left_data;
`endif
`ifdef FAULT_WITHDRAWN
      else if (written == 640) out_left_valid <= 1'b0;
`endif
    end
  end
endmodule
