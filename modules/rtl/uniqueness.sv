// SPDX-License-Identifier: Apache-2.0
// Uniqueness stage: groups of costs and, with the last one of a pixel, its disparity in; the disparity out, invalid if the
// best of the other costs, but for the winner's two neighbours, is not FACTOR / 256 times as high (modules/uniqueness.hpp).
// The disparity must be that of the first of the lowest costs, or invalid, as the subpixel stage has it: then two numbers of
// all groups so far do for the four costs that any other one asks for.
`timescale 1ns / 1ps
`default_nettype none

module uniqueness #(
  parameter int WIDTH = 640,     // px
  parameter int HEIGHT = 480,    // px
  parameter int P = 32,          // costs a cycle; matching.parallelism
  parameter int ITERATIONS = 4,  // groups of them; matching.iterations; at least 4 costs a pixel
  parameter int COST_BITS = 11,
  parameter int FACTOR = 294,    // 256 to 4096
  parameter int INTERVAL = 1,
  parameter int LATENCY = 4      // at least 3
) (
  input wire clk,
  input wire rst,

  input wire [P*COST_BITS-1:0] in_costs_data,
  input wire in_costs_valid,
  input wire in_costs_first,
  input wire in_costs_last,
  output wire in_costs_ready,

  input wire [11:0] in_disparity_data,
  input wire in_disparity_valid,
  input wire in_disparity_first,
  input wire in_disparity_last,
  output wire in_disparity_ready,

  output wire [11:0] out_disparity_data,
  output wire out_disparity_valid,
  input wire out_disparity_ready
);
  wire fires, may_fire, first_group, last_group;
  wire [LATENCY-1:0] moves;
  wire inputs_valid = in_costs_valid && (!last_group || in_disparity_valid);
  stage_control #(
    .WIDTH(WIDTH), .HEIGHT(HEIGHT), .GROUPS(ITERATIONS), .WRITES_LAST(1), .INTERVAL(INTERVAL), .LATENCY(LATENCY)
  ) control (
    .clk(clk), .rst(rst), .inputs_valid(inputs_valid), .may_fire(may_fire), .fires(fires), .reads(), .writes(),
    .group(), .first_group(first_group), .last_group(last_group), .column(), .row(), .moves(moves), .full(),
    .out_valid(out_disparity_valid), .out_ready(out_disparity_ready));
  assign in_costs_ready = may_fire && (!last_group || in_disparity_valid);
  assign in_disparity_ready = may_fire && last_group && in_costs_valid;

  localparam [COST_BITS-1:0] NONE = {COST_BITS{1'b1}};  // no cost is higher
  function automatic [COST_BITS-1:0] lower(input [COST_BITS-1:0] a, input [COST_BITS-1:0] b);
    begin
      lower = b < a ? b : a;
    end
  endfunction
  // The group's costs without those beside its best one, without the first one, without the last one.
  reg [COST_BITS-1:0] best, rival, earlier, earlier_but_last;
  reg best_was_last;  // of the group before
  wire [COST_BITS-1:0] lowest, lowest_apart, lowest_upper, lowest_but_last;
  wire [7:0] index;
  wire [P*COST_BITS-1:0] apart, upper, but_last;
  genvar j;
  generate
    for (j = 0; j < P; j = j + 1) begin : lane
      wire [COST_BITS-1:0] cost = in_costs_data[j*COST_BITS +: COST_BITS];
      wire near = index == 8'(j) || (j > 0 && index == 8'(j - 1)) || index == 8'(j + 1);
      assign apart[j*COST_BITS +: COST_BITS] = near ? NONE : cost;
      assign upper[j*COST_BITS +: COST_BITS] = j == 0 && best_was_last ? NONE : cost;
      assign but_last[j*COST_BITS +: COST_BITS] = j == P - 1 ? NONE : cost;
    end
  endgenerate
  lowest_of #(.N(P), .BITS(COST_BITS)) tree (.values(in_costs_data), .lowest(lowest), .index(index));
  lowest_of #(.N(P), .BITS(COST_BITS)) apart_tree (.values(apart), .lowest(lowest_apart), .index());
  lowest_of #(.N(P), .BITS(COST_BITS)) upper_tree (.values(upper), .lowest(lowest_upper), .index());
  lowest_of #(.N(P), .BITS(COST_BITS)) but_last_tree (.values(but_last), .lowest(lowest_but_last), .index());

  wire wins = first_group || lowest < best;
  wire [COST_BITS-1:0] all_earlier = first_group ? NONE : earlier;
  wire [COST_BITS-1:0] all_but_last = first_group ? NONE : earlier_but_last;
  wire [COST_BITS-1:0] earlier_apart = index == 8'd0 ? all_but_last : all_earlier;
  wire [COST_BITS-1:0] now = wins ? lowest : best;
  wire [COST_BITS-1:0] now_rival;
  assign now_rival = wins ? lower(earlier_apart, lowest_apart) : lower(rival, lowest_upper);
  always_ff @(posedge clk) begin
    if (fires) begin
      best <= now;
      rival <= now_rival;
      best_was_last <= wins && index == 8'(P - 1);
      earlier <= lower(all_earlier, lowest);
      earlier_but_last <= lower(all_earlier, lowest_but_last);
    end
  end

  localparam int SIDE_BITS = COST_BITS + 13;  // a cost times a factor of at most 4096
  reg [COST_BITS-1:0] best_0, rival_0;
  reg [11:0] disparity_0, disparity_1, disparity_2;
  reg [SIDE_BITS-1:0] side_1, rival_side_1;
  wire [SIDE_BITS-1:0] wide_best = SIDE_BITS'(best_0);
  always_ff @(posedge clk) begin
    if (moves[0]) begin
      best_0 <= now;
      rival_0 <= now_rival;
      disparity_0 <= in_disparity_data;
    end
    if (moves[1]) begin
      side_1 <= wide_best * SIDE_BITS'(FACTOR);
      rival_side_1 <= {5'd0, rival_0, 8'd0};
      disparity_1 <= disparity_0;
    end
    if (moves[2]) disparity_2 <= side_1 < rival_side_1 ? disparity_1 : 12'hfff;
  end
  wire [LATENCY-1:0] late = moves >> 3;
  pass_registers #(.BITS(12), .STAGES(LATENCY - 3)) others (
    .clk(clk), .moves(late[(LATENCY > 3 ? LATENCY-4 : 0):0]), .in(disparity_2), .out(out_disparity_data));
endmodule
