// SPDX-License-Identifier: Apache-2.0
// Control of a stage that goes through a frame in raster order, as the model states it (tlm/stage.hpp,
// modules/raster_schedule.hpp): it reads AHEAD pixels before it writes the first one, and writes the last AHEAD after
// it has read them all. A firing that writes goes through LATENCY registers with a handshake each: register i takes
// what is before it when moves[i], that is when it, or one behind it, is empty or the output is taken. A firing that
// writes nothing needs no room.
`timescale 1ns / 1ps
`default_nettype none

module stage_control #(
  parameter int WIDTH = 640,      // px, at least 2
  parameter int HEIGHT = 480,     // px
  parameter int AHEAD = 0,        // px, at most the frame
  parameter int GROUPS = 1,       // firings of a pixel, 1 to 256
  parameter int WRITES_LAST = 0,  // 1: the last firing of a pixel writes; 0: each of them
  parameter int INTERVAL = 1,     // cycles from a firing to the next, at least 1
  parameter int LATENCY = 1       // cycles from a firing to its output, at least 1
) (
  input wire clk,
  input wire rst,

  input wire inputs_valid,  // each input that this firing reads has a token
  output wire may_fire,     // it fires when they have
  output wire fires,
  output wire reads,        // a pixel
  output wire writes,       // a pixel, in this firing or in its last one
  output wire [7:0] group,  // number of the firing within its pixel
  output wire first_group,
  output wire last_group,
  output wire [15:0] column,  // of the pixel written
  output wire [15:0] row,

  output wire [LATENCY-1:0] moves,
  output reg [LATENCY-1:0] full,  // registers that hold a firing
  output wire out_valid,
  input wire out_ready
);
  localparam int PIXELS = WIDTH * HEIGHT;
  localparam int PHASE_BITS = $clog2(PIXELS + AHEAD + 1);
  localparam int X_BITS = $clog2(WIDTH + 1);
  localparam int Y_BITS = $clog2(HEIGHT + 1);
  localparam int GROUP_BITS = $clog2(GROUPS + 1);
  localparam int WAIT_BITS = $clog2(INTERVAL + 1);

  reg [PHASE_BITS-1:0] phase = '0;  // of the next pixel: AHEAD are read, then some both, then AHEAD written
  reg [X_BITS-1:0] x = '0;
  reg [Y_BITS-1:0] y = '0;
  reg [GROUP_BITS-1:0] at = '0;
  reg [WAIT_BITS-1:0] busy = '0;  // cycles until the next firing can be

  assign reads = phase < PHASE_BITS'(PIXELS);
  wire [PHASE_BITS:0] begun = {1'b0, phase} + 1'b1;
  assign writes = begun > (PHASE_BITS + 1)'(AHEAD);
  assign group = 8'(at);
  assign first_group = at == '0;
  assign last_group = at == GROUP_BITS'(GROUPS - 1);
  assign column = 16'(x);
  assign row = 16'(y);

  wire produces = writes && (WRITES_LAST == 0 || last_group);
  assign may_fire = busy == '0 && (!produces || moves[0]);
  assign fires = may_fire && inputs_valid;

  always_ff @(posedge clk) begin
    if (rst) begin
      phase <= '0;
      x <= '0;
      y <= '0;
      at <= '0;
      busy <= '0;
    end else if (fires) begin
      busy <= WAIT_BITS'(INTERVAL - 1);
      at <= last_group ? '0 : at + 1'b1;
      if (last_group) begin
        phase <= phase == PHASE_BITS'(PIXELS + AHEAD - 1) ? '0 : phase + 1'b1;
        if (writes) begin
          x <= x == X_BITS'(WIDTH - 1) ? '0 : x + 1'b1;
          if (x == X_BITS'(WIDTH - 1)) y <= y == Y_BITS'(HEIGHT - 1) ? '0 : y + 1'b1;
        end
      end
    end else if (busy != '0) begin
      busy <= busy - 1'b1;
    end
  end

  genvar i;
  generate
    for (i = 0; i < LATENCY; i = i + 1) begin : place
      assign moves[i] = out_ready || full[LATENCY-1:i] != {(LATENCY - i) {1'b1}};
    end
  endgenerate
  initial full = '0;
  assign out_valid = full[LATENCY-1];
  always_ff @(posedge clk) begin
    if (rst) begin
      full <= '0;
    end else begin
      if (moves[0]) full[0] <= fires && produces;
      for (int k = 1; k < LATENCY; k = k + 1) begin
        if (moves[k]) full[k] <= full[k-1];
      end
    end
  end
endmodule
