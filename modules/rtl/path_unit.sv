// SPDX-License-Identifier: Apache-2.0
// One path of semi-global matching, P disparities in a step and a pixel in ITERATIONS steps (modules/matching.hpp):
//   L(k) = C(k) + min(L'(k), L'(k-1) + P1, L'(k+1) + P1, m + P2) - m, m the lowest L', L' of the pixel DELAY before in raster
// order; L = C where `starts`. The lowest L of a pixel is there one cycle after its last group: the recurrence's latency is 1.
`timescale 1ns / 1ps
`default_nettype none

module path_unit #(
  parameter int P = 8,           // disparities a step
  parameter int ITERATIONS = 4,  // steps a pixel
  parameter int DELAY = 1,       // pixels to the predecessor; not 2
  parameter int COST_BITS = 5,
  parameter int PATH_BITS = 9,
  parameter int P1 = 8,
  parameter int P2 = 42
) (
  input wire clk,
  input wire step,
  input wire first_group,
  input wire last_group,
  input wire starts,
  input wire [P*COST_BITS-1:0] costs,
  output wire [P*PATH_BITS-1:0] path_costs
);
  localparam int WIDE = PATH_BITS + 1;  // with a penalty
  wire [P*PATH_BITS-1:0] group;         // of the predecessor, the same disparities
  wire [P*PATH_BITS-1:0] next_group;
  reg [PATH_BITS-1:0] below_group;
  wire [PATH_BITS-1:0] minimum;         // of the predecessor
  wire [PATH_BITS-1:0] group_minimum;
  reg [PATH_BITS-1:0] minimum_so_far;
  wire [PATH_BITS-1:0] pixel_minimum = first_group || group_minimum < minimum_so_far ? group_minimum : minimum_so_far;
  wire pixel_ends = step && last_group;

  step_delay #(.WORDS(DELAY * ITERATIONS), .BITS(P * PATH_BITS), .REGISTERS(DELAY == 1 ? 1 : 0)) costs_before (
    .clk(clk), .step(step), .in(path_costs), .current(group), .following(next_group));
  step_delay #(.WORDS(DELAY), .BITS(PATH_BITS), .REGISTERS(DELAY == 1 ? 1 : 0)) minima_before (
    .clk(clk), .step(pixel_ends), .in(pixel_minimum), .current(minimum), .following());
  lowest_of #(.N(P), .BITS(PATH_BITS)) tree (.values(path_costs), .lowest(group_minimum), .index());

  always_ff @(posedge clk) begin
    if (step) begin
      below_group <= group[(P-1)*PATH_BITS +: PATH_BITS];
      minimum_so_far <= pixel_minimum;
    end
  end

  wire [WIDE-1:0] jump = WIDE'(minimum) + WIDE'(P2);
  genvar j;
  generate
    for (j = 0; j < P; j = j + 1) begin : lane
      wire [PATH_BITS-1:0] same = group[j*PATH_BITS +: PATH_BITS];
      wire [PATH_BITS-1:0] below;
      wire [PATH_BITS-1:0] above;
      wire has_below;
      wire has_above;
      if (j == 0) begin : lowest_lane
        assign below = below_group;
        assign has_below = !first_group;
      end else begin : other_lane
        assign below = group[(j-1)*PATH_BITS +: PATH_BITS];
        assign has_below = 1'b1;
      end
      if (j == P - 1) begin : highest_lane
        assign above = next_group[0 +: PATH_BITS];
        assign has_above = !last_group;
      end else begin : inner_lane
        assign above = group[(j+1)*PATH_BITS +: PATH_BITS];
        assign has_above = 1'b1;
      end
      wire [WIDE-1:0] from_below = WIDE'(below) + WIDE'(P1);
      wire [WIDE-1:0] from_above = WIDE'(above) + WIDE'(P1);
      wire [WIDE-1:0] stay_or_jump = WIDE'(same) < jump ? WIDE'(same) : jump;
      wire [WIDE-1:0] or_below = has_below && from_below < stay_or_jump ? from_below : stay_or_jump;
      wire [WIDE-1:0] best = has_above && from_above < or_below ? from_above : or_below;
      wire [WIDE-1:0] added = best - WIDE'(minimum);  // at most P2
      wire [PATH_BITS-1:0] cost = PATH_BITS'(costs[j*COST_BITS +: COST_BITS]);
      assign path_costs[j*PATH_BITS +: PATH_BITS] = starts ? cost : cost + PATH_BITS'(added);
    end
  endgenerate
endmodule
