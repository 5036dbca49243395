// SPDX-License-Identifier: Apache-2.0
// Rectification stage: pixels of both images in, half a window of rows ahead of the map entries; rectified pixels out
// (modules/rectification_stage.hpp). It holds a row more than the window, so that two rows read together lie in two memories.
`timescale 1ns / 1ps
`default_nettype none

module rectification #(
  parameter int WIDTH = 640,        // px, at least the window
  parameter int HEIGHT = 480,       // px, more than half the window
  parameter int WINDOW = 79,        // px, odd; rectification.window
  parameter int FRACTION_BITS = 5,  // at least 1; rectification.fraction_bits
  parameter int OFFSET_BITS = 12,   // a quarter of the map's token
  parameter int INTERVAL = 1,
  parameter int LATENCY = 10,       // at least 8
  parameter int TOGETHER = 0        // output_pair.sv
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

  input wire [4*OFFSET_BITS-1:0] in_map_data,
  input wire in_map_valid,
  input wire in_map_first,
  input wire in_map_last,
  output wire in_map_ready,

  output wire [7:0] out_left_data,
  output wire out_left_valid,
  input wire out_left_ready,

  output wire [7:0] out_right_data,
  output wire out_right_valid,
  input wire out_right_ready
);
  localparam int REACH = WINDOW / 2;
  localparam int SLOTS = WINDOW + 1;
  wire reads, writes, fires, may_fire, out_valid, out_ready;
  wire [15:0] column;
  wire [15:0] row;
  wire [LATENCY-1:0] moves;
  wire inputs_valid = (!reads || (in_left_valid && in_right_valid)) && (!writes || in_map_valid);
  stage_control #(
    .WIDTH(WIDTH), .HEIGHT(HEIGHT), .AHEAD(REACH * WIDTH + REACH), .INTERVAL(INTERVAL), .LATENCY(LATENCY)
  ) control (
    .clk(clk), .rst(rst), .inputs_valid(inputs_valid), .may_fire(may_fire), .fires(fires), .reads(reads), .writes(writes),
    .group(), .first_group(), .last_group(), .column(column), .row(row), .moves(moves), .full(),
    .out_valid(out_valid), .out_ready(out_ready));
  assign in_left_ready = may_fire && reads && in_right_valid && (!writes || in_map_valid);
  assign in_right_ready = may_fire && reads && in_left_valid && (!writes || in_map_valid);
  assign in_map_ready = may_fire && writes && (!reads || (in_left_valid && in_right_valid));
  output_pair #(.TOGETHER(TOGETHER)) outputs (
    .clk(clk), .rst(rst), .valid(out_valid), .ready(out_ready), .a_valid(out_left_valid), .a_ready(out_left_ready),
    .b_valid(out_right_valid), .b_ready(out_right_ready));

  // Where the next pixel goes, and where the row written lies; both go on from frame to frame.
  localparam int X_BITS = $clog2(WIDTH);
  localparam int SLOT_BITS = $clog2(SLOTS);
  reg [X_BITS-1:0] write_column = '0;
  reg [SLOT_BITS-1:0] write_slot = '0;
  reg [SLOT_BITS-1:0] slot = '0;
  wire pixel_comes = fires && reads;
  always_ff @(posedge clk) begin
    if (rst) begin
      write_column <= '0;
      write_slot <= '0;
      slot <= '0;
    end else begin
      if (pixel_comes) begin
        write_column <= write_column == X_BITS'(WIDTH - 1) ? '0 : write_column + 1'b1;
        if (write_column == X_BITS'(WIDTH - 1)) write_slot <= write_slot == SLOT_BITS'(SLOTS - 1) ? '0 : write_slot + 1'b1;
      end
      if (fires && writes && column == 16'(WIDTH - 1)) slot <= slot == SLOT_BITS'(SLOTS - 1) ? '0 : slot + 1'b1;
    end
  end
  wire [15:0] pixel_column = 16'(write_column);
  wire [15:0] pixel_slot = 16'(write_slot);
  wire [15:0] row_slot = 16'(slot);
  wire [OFFSET_BITS-1:0] left_dx = in_map_data[0 +: OFFSET_BITS];
  wire [OFFSET_BITS-1:0] left_dy = in_map_data[OFFSET_BITS +: OFFSET_BITS];
  wire [OFFSET_BITS-1:0] right_dx = in_map_data[2*OFFSET_BITS +: OFFSET_BITS];
  wire [OFFSET_BITS-1:0] right_dy = in_map_data[3*OFFSET_BITS +: OFFSET_BITS];
  bilinear #(
    .WIDTH(WIDTH), .HEIGHT(HEIGHT), .SLOTS(SLOTS), .OFFSET_BITS(OFFSET_BITS), .FRACTION_BITS(FRACTION_BITS),
    .STAGES(LATENCY)
  ) left (
    .clk(clk), .writes(pixel_comes), .write_column(pixel_column), .write_slot(pixel_slot), .pixel(in_left_data),
    .moves(moves), .column(column), .row(row), .slot(row_slot), .dx(left_dx), .dy(left_dy), .out(out_left_data));
  bilinear #(
    .WIDTH(WIDTH), .HEIGHT(HEIGHT), .SLOTS(SLOTS), .OFFSET_BITS(OFFSET_BITS), .FRACTION_BITS(FRACTION_BITS),
    .STAGES(LATENCY)
  ) right (
    .clk(clk), .writes(pixel_comes), .write_column(pixel_column), .write_slot(pixel_slot), .pixel(in_right_data),
    .moves(moves), .column(column), .row(row), .slot(row_slot), .dx(right_dx), .dy(right_dy), .out(out_right_data));
endmodule
