// SPDX-License-Identifier: Apache-2.0
// Noise reduction stage, kind "median_3x3": each disparity whose window of 3 x 3 lies in the image becomes the median of the
// window, in which an invalid one is the largest; all others pass unchanged (modules/noise_reduction.hpp).
`timescale 1ns / 1ps
`default_nettype none

module median_3x3 #(
  parameter int WIDTH = 640,   // px, at least 2
  parameter int HEIGHT = 480,  // px, at least 2
  parameter int INTERVAL = 1,
  parameter int LATENCY = 8    // at least 3
) (
  input wire clk,
  input wire rst,

  input wire [11:0] in_disparity_data,
  input wire in_disparity_valid,
  input wire in_disparity_first,
  input wire in_disparity_last,
  output wire in_disparity_ready,

  output wire [11:0] out_disparity_data,
  output wire out_disparity_valid,
  input wire out_disparity_ready
);
  wire fires, may_fire, reads;
  wire [15:0] column;
  wire [15:0] row;
  wire [LATENCY-1:0] moves;
  wire inputs_valid = !reads || in_disparity_valid;
  stage_control #(
    .WIDTH(WIDTH), .HEIGHT(HEIGHT), .AHEAD(WIDTH + 1), .INTERVAL(INTERVAL), .LATENCY(LATENCY)
  ) control (
    .clk(clk), .rst(rst), .inputs_valid(inputs_valid), .may_fire(may_fire), .fires(fires), .reads(reads), .writes(),
    .group(), .first_group(), .last_group(), .column(column), .row(row), .moves(moves), .full(),
    .out_valid(out_disparity_valid), .out_ready(out_disparity_ready));
  assign in_disparity_ready = may_fire && reads;
  wire covered = column != 16'd0 && column != 16'(WIDTH - 1) && row != 16'd0 && row != 16'(HEIGHT - 1);  // its window

  // A column is sorted once, when its last pixel comes; the window is three sorted columns.
  wire [9*12-1:0] shifted;
  raster_window #(.WIDTH(WIDTH), .ROWS(3), .COLUMNS(3), .BITS(12)) pixels (
    .clk(clk), .fires(fires), .pixel(in_disparity_data), .window(shifted));
  wire [3*12-1:0] newest;
  sort_three column_sorter (.in(shifted[6*12 +: 3*12]), .sorted(newest));
  reg [6*12-1:0] sorted_columns;
  reg [9*12-1:0] window_0;  // value r of column c is number 3 * c + r
  reg [11:0] centre_0, centre_1, median_2;
  reg covered_0, covered_1;

  // The median of all is that of the highest of the lowest values, the middle of the middle ones, and the lowest of the highest.
  wire [3*3*12-1:0] ranks;  // the three lowest of their columns, the three middle ones, the three highest
  wire [3*3*12-1:0] ordered;
  genvar r;
  generate
    for (r = 0; r < 3; r = r + 1) begin : rank
      assign ranks[r*3*12 +: 3*12] = {window_0[(6+r)*12 +: 12], window_0[(3+r)*12 +: 12], window_0[r*12 +: 12]};
      sort_three sorter (.in(ranks[r*3*12 +: 3*12]), .sorted(ordered[r*3*12 +: 3*12]));
    end
  endgenerate
  reg [3*12-1:0] candidates_1;
  wire [3*12-1:0] middle;
  sort_three last_sorter (.in(candidates_1), .sorted(middle));
  always_ff @(posedge clk) begin
    if (fires) sorted_columns <= {newest, sorted_columns[6*12-1:3*12]};
    if (moves[0]) begin
      window_0 <= {newest, sorted_columns};
      centre_0 <= shifted[4*12 +: 12];
      covered_0 <= covered;
    end
    if (moves[1]) begin
      candidates_1 <= {ordered[6*12 +: 12], ordered[4*12 +: 12], ordered[2*12 +: 12]};
      centre_1 <= centre_0;
      covered_1 <= covered_0;
    end
    if (moves[2]) median_2 <= covered_1 ? middle[12 +: 12] : centre_1;
  end
  wire [LATENCY-1:0] late = moves >> 3;
  pass_registers #(.BITS(12), .STAGES(LATENCY - 3)) others (
    .clk(clk), .moves(late[(LATENCY > 3 ? LATENCY-4 : 0):0]), .in(median_2), .out(out_disparity_data));
endmodule
