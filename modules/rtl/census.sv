// SPDX-License-Identifier: Apache-2.0
// Census stage: both rectified images in, their census codes out (modules/census_stage.hpp).
`timescale 1ns / 1ps
`default_nettype none

module census #(
  parameter int WIDTH = 640,        // px, more than half the window
  parameter int HEIGHT = 480,       // px, more than half the window
  parameter int WINDOW_WIDTH = 5,   // px, odd, 3 to 21
  parameter int WINDOW_HEIGHT = 5,  // px, odd, 3 to 21; both together at most 63 neighbours
  parameter int INTERVAL = 1,
  parameter int LATENCY = 4,        // at least 4
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

  output wire [WINDOW_WIDTH*WINDOW_HEIGHT-2:0] out_left_data,
  output wire out_left_valid,
  input wire out_left_ready,

  output wire [WINDOW_WIDTH*WINDOW_HEIGHT-2:0] out_right_data,
  output wire out_right_valid,
  input wire out_right_ready
);
  wire reads, fires, may_fire, out_valid, out_ready;
  wire [15:0] column;
  wire [15:0] row;
  wire [LATENCY-1:0] moves;
  wire both_valid = in_left_valid && in_right_valid;
  wire inputs_valid = !reads || both_valid;
  stage_control #(
    .WIDTH(WIDTH), .HEIGHT(HEIGHT), .AHEAD(WINDOW_HEIGHT / 2 * WIDTH + WINDOW_WIDTH / 2), .INTERVAL(INTERVAL),
    .LATENCY(LATENCY)
  ) control (
    .clk(clk), .rst(rst), .inputs_valid(inputs_valid), .may_fire(may_fire), .fires(fires), .reads(reads), .writes(),
    .group(), .first_group(), .last_group(), .column(column), .row(row), .moves(moves), .full(),
    .out_valid(out_valid), .out_ready(out_ready));
  assign in_left_ready = may_fire && reads && in_right_valid;
  assign in_right_ready = may_fire && reads && in_left_valid;
  output_pair #(.TOGETHER(TOGETHER)) outputs (
    .clk(clk), .rst(rst), .valid(out_valid), .ready(out_ready), .a_valid(out_left_valid), .a_ready(out_left_ready),
    .b_valid(out_right_valid), .b_ready(out_right_ready));

  wire [WINDOW_WIDTH-1:0] columns_exist;
  wire [WINDOW_HEIGHT-1:0] rows_exist;
  in_image #(.SIZE(WIDTH), .REACH(WINDOW_WIDTH / 2)) columns (.at(column), .exists(columns_exist));
  in_image #(.SIZE(HEIGHT), .REACH(WINDOW_HEIGHT / 2)) rows (.at(row), .exists(rows_exist));
  census_image #(
    .WIDTH(WIDTH), .WINDOW_WIDTH(WINDOW_WIDTH), .WINDOW_HEIGHT(WINDOW_HEIGHT), .STAGES(LATENCY)
  ) left (
    .clk(clk), .fires(fires), .pixel(in_left_data), .columns_exist(columns_exist), .rows_exist(rows_exist),
    .moves(moves), .code(out_left_data));
  census_image #(
    .WIDTH(WIDTH), .WINDOW_WIDTH(WINDOW_WIDTH), .WINDOW_HEIGHT(WINDOW_HEIGHT), .STAGES(LATENCY)
  ) right (
    .clk(clk), .fires(fires), .pixel(in_right_data), .columns_exist(columns_exist), .rows_exist(rows_exist),
    .moves(moves), .code(out_right_data));
endmodule
