// SPDX-License-Identifier: Apache-2.0
// Subpixel stage: groups of costs in; with the last one of a pixel the first of the lowest costs, refined by the
// equiangular curve, out (modules/subpixel.hpp: rounding toward zero, masked border).
`timescale 1ns / 1ps
`default_nettype none

module subpixel #(
  parameter int WIDTH = 640,        // px
  parameter int HEIGHT = 480,       // px
  parameter int P = 32,             // costs a cycle; matching.parallelism
  parameter int ITERATIONS = 4,     // groups of them; matching.iterations
  parameter int COST_BITS = 11,
  parameter int OFFSET = 0,         // px, the smallest disparity; matching.disparity_offset
  parameter int BORDER_WIDTH = 2,   // px, masked left and right
  parameter int BORDER_HEIGHT = 2,  // px, masked at top and bottom
  parameter int INTERVAL = 1,
  parameter int LATENCY = 16        // at least 7
) (
  input wire clk,
  input wire rst,

  input wire [P*COST_BITS-1:0] in_costs_data,
  input wire in_costs_valid,
  input wire in_costs_first,
  input wire in_costs_last,
  output wire in_costs_ready,

  output wire [11:0] out_disparity_data,
  output wire out_disparity_valid,
  input wire out_disparity_ready
);
  wire fires, may_fire, first_group, last_group;
  wire [7:0] group;
  wire [15:0] column;
  wire [15:0] row;
  wire [LATENCY-1:0] moves;
  stage_control #(
    .WIDTH(WIDTH), .HEIGHT(HEIGHT), .GROUPS(ITERATIONS), .WRITES_LAST(1), .INTERVAL(INTERVAL), .LATENCY(LATENCY)
  ) control (
    .clk(clk), .rst(rst), .inputs_valid(in_costs_valid), .may_fire(may_fire), .fires(fires), .reads(), .writes(),
    .group(group), .first_group(first_group), .last_group(last_group), .column(column), .row(row), .moves(moves), .full(),
    .out_valid(out_disparity_valid), .out_ready(out_disparity_ready));
  assign in_costs_ready = may_fire;
  wire masked = column < 16'(BORDER_WIDTH) || column >= 16'(WIDTH - BORDER_WIDTH) ||
                row < 16'(BORDER_HEIGHT) || row >= 16'(HEIGHT - BORDER_HEIGHT);

  // The best cost of the groups so far with its neighbours, of which the upper one may come with the next group.
  reg [COST_BITS-1:0] best, best_below, best_above, last_cost;
  reg [7:0] best_at;
  reg above_comes;
  wire [COST_BITS-1:0] lowest;
  wire [7:0] index;
  lowest_of #(.N(P), .BITS(COST_BITS)) tree (.values(in_costs_data), .lowest(lowest), .index(index));
  wire [COST_BITS-1:0] below;
  wire [COST_BITS-1:0] above;
  wire [7:0] base;  // of the group
  function automatic [COST_BITS-1:0] cost_at(input [(P+2)*COST_BITS-1:0] costs, input [8:0] i);
    begin
      cost_at = '0;
      for (int k = 0; k < P + 2; k = k + 1) begin
        if (i == 9'(k)) cost_at = costs[k*COST_BITS +: COST_BITS];
      end
    end
  endfunction
  function automatic [7:0] base_of(input [7:0] of_group);
    begin
      base_of = 8'd0;
      for (int k = 1; k < ITERATIONS; k = k + 1) begin
        if (of_group == 8'(k)) base_of = 8'(k * P);
      end
    end
  endfunction
  wire [(P+2)*COST_BITS-1:0] around = {{COST_BITS{1'b0}}, in_costs_data, last_cost};  // number 0 is that below the group
  wire [8:0] below_index = {1'b0, index};
  wire [8:0] above_index = below_index + 9'd2;
  assign below = cost_at(around, below_index);
  assign above = cost_at(around, above_index);
  assign base = base_of(group);
  wire wins = first_group || lowest < best;
  wire [COST_BITS-1:0] now = wins ? lowest : best;
  wire [7:0] now_at = wins ? base + index : best_at;
  wire [COST_BITS-1:0] now_below = wins ? below : best_below;
  wire [COST_BITS-1:0] stored_above = above_comes ? in_costs_data[0 +: COST_BITS] : best_above;
  wire [COST_BITS-1:0] now_above = wins ? above : stored_above;
  always_ff @(posedge clk) begin
    if (fires) begin
      best <= now;
      best_at <= now_at;
      best_below <= now_below;
      best_above <= now_above;
      above_comes <= wins && index == 8'(P - 1);
      last_cost <= in_costs_data[(P-1)*COST_BITS +: COST_BITS];
    end
  end

  // f = 8 (below - above) / m, m = max(below, above) - lowest, of at most 8: four bits of a quotient, a register each.
  localparam int REST_BITS = COST_BITS + 4;
  reg [COST_BITS-1:0] best_0, below_0, above_0;
  reg [7:0] at_0;
  reg between_0, masked_0;
  wire up_0 = below_0 > above_0;  // the curve's minimum lies above the winner
  wire [COST_BITS-1:0] higher_0 = up_0 ? below_0 : above_0;
  wire [COST_BITS-1:0] lower_0 = up_0 ? above_0 : below_0;
  reg [REST_BITS-1:0] rest_1;
  reg [COST_BITS-1:0] slope_1;
  reg [9:0] about_1;  // disparity, up, masked
  always_ff @(posedge clk) begin
    if (moves[0]) begin
      best_0 <= now;
      below_0 <= now_below;
      above_0 <= now_above;
      at_0 <= now_at;
      between_0 <= now_at != 8'd0 && now_at != 8'(P * ITERATIONS - 1);
      masked_0 <= masked;
    end
    if (moves[1]) begin
      rest_1 <= between_0 ? {1'b0, higher_0 - lower_0, 3'd0} : '0;
      slope_1 <= higher_0 - best_0;
      about_1 <= {at_0 + 8'(OFFSET), up_0, masked_0};
    end
  end
  genvar i;
  generate
    for (i = 0; i < 4; i = i + 1) begin : bit_of
      wire [REST_BITS-1:0] rest_in;
      wire [COST_BITS-1:0] slope_in;
      wire [9:0] about_in;
      wire [3:0] quotient_in;
      if (i == 0) begin : first
        assign rest_in = rest_1;
        assign slope_in = slope_1;
        assign about_in = about_1;
        assign quotient_in = 4'd0;
      end else begin : other
        assign rest_in = bit_of[i-1].rest;
        assign slope_in = bit_of[i-1].slope;
        assign about_in = bit_of[i-1].about;
        assign quotient_in = bit_of[i-1].quotient;
      end
      reg [REST_BITS-1:0] rest;
      reg [COST_BITS-1:0] slope;
      reg [9:0] about;
      reg [3:0] quotient;
      wire [REST_BITS-1:0] part = REST_BITS'(slope_in) << (3 - i);
      wire fits = rest_in >= part && rest_in != '0;
      always_ff @(posedge clk) begin
        if (moves[2+i]) begin
          rest <= fits ? rest_in - part : rest_in;
          quotient <= {quotient_in[2:0], fits};
          slope <= slope_in;
          about <= about_in;
        end
      end
    end
  endgenerate
  wire [9:0] about_it = bit_of[3].about;
  wire [3:0] sixteenths = bit_of[3].quotient;
  wire up = about_it[1];
  wire is_masked = about_it[0];
  wire [11:0] whole = {about_it[9:2], 4'd0};
  wire [11:0] fraction = {8'd0, sixteenths};
  reg [11:0] disparity;
  always_ff @(posedge clk) begin
    if (moves[6]) disparity <= is_masked ? 12'hfff : up ? whole + fraction : whole - fraction;
  end
  wire [LATENCY-1:0] late = moves >> 7;
  pass_registers #(.BITS(12), .STAGES(LATENCY - 7)) others (
    .clk(clk), .moves(late[(LATENCY > 7 ? LATENCY-8 : 0):0]), .in(disparity), .out(out_disparity_data));
endmodule
