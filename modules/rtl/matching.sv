// SPDX-License-Identifier: Apache-2.0
// Matching stage: a pair of census codes in, ITERATIONS groups of P summed path costs out, with the paths W, NW, N and NE
// (modules/matching.hpp, modules/matching_stage.hpp): the window of right codes, Hamming distances, path costs, sums; a
// register each.
`timescale 1ns / 1ps
`default_nettype none

module matching #(
  parameter int WIDTH = 640,     // px, at least 4
  parameter int HEIGHT = 480,    // px
  parameter int P = 32,          // disparities a cycle; matching.parallelism
  parameter int ITERATIONS = 4,  // groups of them; matching.iterations
  parameter int CODE_BITS = 24,  // at most 63
  parameter int COST_WEIGHT = 2, // of a differing bit, 1 to 4
  parameter int P1 = 8,
  parameter int P2 = 42,         // more than P1, at most 255
  parameter int INTERVAL = 1,
  parameter int LATENCY = 24,    // at least 4
  parameter int SUM_BITS = $clog2(4 * (COST_WEIGHT * CODE_BITS + 255) + 1)
) (
  input wire clk,
  input wire rst,

  input wire [CODE_BITS-1:0] in_left_data,
  input wire in_left_valid,
  input wire in_left_first,
  input wire in_left_last,
  output wire in_left_ready,

  input wire [CODE_BITS-1:0] in_right_data,
  input wire in_right_valid,
  input wire in_right_first,
  input wire in_right_last,
  output wire in_right_ready,

  output wire [P*SUM_BITS-1:0] out_costs_data,
  output wire out_costs_valid,
  input wire out_costs_ready
);
  localparam int D = P * ITERATIONS;
  localparam int COST_BITS = $clog2(COST_WEIGHT * CODE_BITS + 1);
  localparam int PATH_BITS = $clog2(COST_WEIGHT * CODE_BITS + 255 + 1);

  wire fires, may_fire, first_group, last_group;
  wire [7:0] group;
  wire [15:0] column;
  wire [15:0] row;
  wire [LATENCY-1:0] moves;
  wire [LATENCY-1:0] full;
  wire both_valid = in_left_valid && in_right_valid;
  wire inputs_valid = !first_group || both_valid;
  stage_control #(
    .WIDTH(WIDTH), .HEIGHT(HEIGHT), .GROUPS(ITERATIONS), .INTERVAL(INTERVAL), .LATENCY(LATENCY)
  ) control (
    .clk(clk), .rst(rst), .inputs_valid(inputs_valid), .may_fire(may_fire), .fires(fires), .reads(), .writes(),
    .group(group), .first_group(first_group), .last_group(last_group), .column(column), .row(row), .moves(moves),
    .full(full), .out_valid(out_costs_valid), .out_ready(out_costs_ready));
  assign in_left_ready = may_fire && first_group && in_right_valid;
  assign in_right_ready = may_fire && first_group && in_left_valid;

  // The right codes of disparities 0, 1, ... of this pixel; left of the image the row's first one.
  reg [CODE_BITS-1:0] held_left;
  reg [D*CODE_BITS-1:0] held_right;
  wire [CODE_BITS-1:0] left = first_group ? in_left_data : held_left;
  wire [(D+1)*CODE_BITS-1:0] shifted = {held_right, in_right_data};
  wire [D*CODE_BITS-1:0] right = !first_group ? held_right : column == 16'd0 ? {D{in_right_data}} : shifted[D*CODE_BITS-1:0];
  function automatic [P*CODE_BITS-1:0] codes_of(input [D*CODE_BITS-1:0] codes, input [7:0] of_group);
    begin
      codes_of = codes[0 +: P*CODE_BITS];
      for (int i = 1; i < ITERATIONS; i = i + 1) begin
        if (of_group == 8'(i)) codes_of = codes[i*P*CODE_BITS +: P*CODE_BITS];
      end
    end
  endfunction
  wire [P*CODE_BITS-1:0] candidates;
  assign candidates = codes_of(right, group);
  always_ff @(posedge clk) begin
    if (fires) begin
      held_left <= left;
      held_right <= right;
    end
  end

  // What a group of costs has to know of its place goes with it.
  wire [4:0] place = {first_group, last_group, column == 16'd0, column == 16'(WIDTH - 1), row == 16'd0};
  reg [4:0] place_0;
  reg [4:0] place_1;
  reg [CODE_BITS-1:0] left_0;
  reg [P*CODE_BITS-1:0] right_0;
  reg [P*COST_BITS-1:0] costs_1;
  wire [P*COST_BITS-1:0] distances;
  function automatic [COST_BITS-1:0] ones(input [CODE_BITS-1:0] code);
    begin
      ones = '0;
      for (int i = 0; i < CODE_BITS; i = i + 1) ones = ones + COST_BITS'(code[i]);
    end
  endfunction
  genvar j;
  generate
    for (j = 0; j < P; j = j + 1) begin : distance
      wire [CODE_BITS-1:0] differing = left_0 ^ right_0[j*CODE_BITS +: CODE_BITS];
      wire [COST_BITS-1:0] bits;
      assign bits = ones(differing);
      wire [COST_BITS-1:0] once = COST_WEIGHT % 2 != 0 ? bits : '0;
      wire [COST_BITS-1:0] twice = COST_WEIGHT / 2 % 2 != 0 ? bits << 1 : '0;
      wire [COST_BITS-1:0] four_times = COST_WEIGHT / 4 != 0 ? bits << 2 : '0;
      assign distances[j*COST_BITS +: COST_BITS] = once + twice + four_times;
    end
  endgenerate
  always_ff @(posedge clk) begin
    if (moves[0]) begin
      place_0 <= place;
      left_0 <= left;
      right_0 <= candidates;
    end
    if (moves[1]) begin
      place_1 <= place_0;
      costs_1 <= distances;
    end
  end

  wire step = moves[2] && full[1];
  wire first_1, last_1, at_left, at_right, at_top;
  assign {first_1, last_1, at_left, at_right, at_top} = place_1;
  wire north_west_starts = at_top || at_left;
  wire north_east_starts = at_top || at_right;
  wire [P*PATH_BITS-1:0] west;
  wire [P*PATH_BITS-1:0] north_west;
  wire [P*PATH_BITS-1:0] north;
  wire [P*PATH_BITS-1:0] north_east;
  path_unit #(
    .P(P), .ITERATIONS(ITERATIONS), .DELAY(1), .COST_BITS(COST_BITS), .PATH_BITS(PATH_BITS), .P1(P1), .P2(P2)
  ) path_west (
    .clk(clk), .step(step), .first_group(first_1), .last_group(last_1), .starts(at_left), .costs(costs_1),
    .path_costs(west));
  path_unit #(
    .P(P), .ITERATIONS(ITERATIONS), .DELAY(WIDTH + 1), .COST_BITS(COST_BITS), .PATH_BITS(PATH_BITS), .P1(P1), .P2(P2)
  ) path_north_west (
    .clk(clk), .step(step), .first_group(first_1), .last_group(last_1), .starts(north_west_starts), .costs(costs_1),
    .path_costs(north_west));
  path_unit #(
    .P(P), .ITERATIONS(ITERATIONS), .DELAY(WIDTH), .COST_BITS(COST_BITS), .PATH_BITS(PATH_BITS), .P1(P1), .P2(P2)
  ) path_north (
    .clk(clk), .step(step), .first_group(first_1), .last_group(last_1), .starts(at_top), .costs(costs_1),
    .path_costs(north));
  path_unit #(
    .P(P), .ITERATIONS(ITERATIONS), .DELAY(WIDTH - 1), .COST_BITS(COST_BITS), .PATH_BITS(PATH_BITS), .P1(P1), .P2(P2)
  ) path_north_east (
    .clk(clk), .step(step), .first_group(first_1), .last_group(last_1), .starts(north_east_starts), .costs(costs_1),
    .path_costs(north_east));

  reg [P*PATH_BITS-1:0] west_2;
  reg [P*PATH_BITS-1:0] north_west_2;
  reg [P*PATH_BITS-1:0] north_2;
  reg [P*PATH_BITS-1:0] north_east_2;
  reg [P*SUM_BITS-1:0] sums_3;
  always_ff @(posedge clk) begin
    if (moves[2]) begin
      west_2 <= west;
      north_west_2 <= north_west;
      north_2 <= north;
      north_east_2 <= north_east;
    end
    if (moves[3]) begin
      for (int i = 0; i < P; i = i + 1) begin
        sums_3[i*SUM_BITS +: SUM_BITS] <=
            (SUM_BITS'(west_2[i*PATH_BITS +: PATH_BITS]) + SUM_BITS'(north_west_2[i*PATH_BITS +: PATH_BITS])) +
            (SUM_BITS'(north_2[i*PATH_BITS +: PATH_BITS]) + SUM_BITS'(north_east_2[i*PATH_BITS +: PATH_BITS]));
      end
    end
  end
  wire [LATENCY-1:0] late = moves >> 4;
  pass_registers #(.BITS(P * SUM_BITS), .STAGES(LATENCY - 4)) rest (
    .clk(clk), .moves(late[(LATENCY > 4 ? LATENCY-5 : 0):0]), .in(sums_3), .out(out_costs_data));
endmodule
