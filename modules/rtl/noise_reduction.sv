// SPDX-License-Identifier: Apache-2.0
// Noise reduction stage, kind "mean": each valid disparity becomes the rounded mean of those in its window that are valid, in
// the image, and differ from it by at most MAX_DIFFERENCE (modules/noise_reduction.hpp).
`timescale 1ns / 1ps
`default_nettype none

module noise_reduction #(
  parameter int WIDTH = 640,          // px, more than half the window
  parameter int HEIGHT = 480,         // px, more than half the window
  parameter int WINDOW = 3,           // px, odd, 3 to 7
  parameter int MAX_DIFFERENCE = 24,  // 1/16 px, 0 to 4094
  parameter int INTERVAL = 1,
  parameter int LATENCY = 8           // at least 7
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
  localparam int REACH = WINDOW / 2;
  localparam int PLACES = WINDOW * WINDOW;
  localparam int COUNT_BITS = $clog2(PLACES + 1);
  localparam int SUM_BITS = 12 + COUNT_BITS;
  localparam [11:0] INVALID = 12'hfff;

  wire fires, may_fire, reads;
  wire [15:0] column;
  wire [15:0] row;
  wire [LATENCY-1:0] moves;
  wire inputs_valid = !reads || in_disparity_valid;
  stage_control #(
    .WIDTH(WIDTH), .HEIGHT(HEIGHT), .AHEAD(REACH * WIDTH + REACH), .INTERVAL(INTERVAL), .LATENCY(LATENCY)
  ) control (
    .clk(clk), .rst(rst), .inputs_valid(inputs_valid), .may_fire(may_fire), .fires(fires), .reads(reads), .writes(),
    .group(), .first_group(), .last_group(), .column(column), .row(row), .moves(moves), .full(),
    .out_valid(out_disparity_valid), .out_ready(out_disparity_ready));
  assign in_disparity_ready = may_fire && reads;

  wire [WINDOW-1:0] columns_exist;
  wire [WINDOW-1:0] rows_exist;
  in_image #(.SIZE(WIDTH), .REACH(REACH)) columns (.at(column), .exists(columns_exist));
  in_image #(.SIZE(HEIGHT), .REACH(REACH)) rows (.at(row), .exists(rows_exist));
  wire [PLACES*12-1:0] shifted;
  raster_window #(.WIDTH(WIDTH), .ROWS(WINDOW), .COLUMNS(WINDOW), .BITS(12)) pixels (
    .clk(clk), .fires(fires), .pixel(in_disparity_data), .window(shifted));

  // The window; who counts; sums of columns; their sum; what is divided; the product; the mean.
  reg [PLACES*12-1:0] window_0;
  reg [WINDOW-1:0] columns_0, rows_0;
  reg [PLACES-1:0] counts_1;
  reg [PLACES*12-1:0] values_1;
  reg [WINDOW*SUM_BITS-1:0] sums_2;
  reg [WINDOW*COUNT_BITS-1:0] numbers_2;
  reg [SUM_BITS-1:0] sum_3;
  reg [COUNT_BITS-1:0] number_3, number_4;
  reg [SUM_BITS:0] dividend_4;
  reg [11:0] centre_1, centre_2, centre_3, centre_4, centre_5, mean_6;
  wire [11:0] centre_0 = window_0[(PLACES/2)*12 +: 12];
  wire [PLACES-1:0] counts;
  genvar i;
  generate
    for (i = 0; i < PLACES; i = i + 1) begin : place
      wire [11:0] value = window_0[i*12 +: 12];
      wire [11:0] difference = value < centre_0 ? centre_0 - value : value - centre_0;
      wire exists = columns_0[i / WINDOW] && rows_0[i % WINDOW];
      assign counts[i] = exists && value != INVALID && difference <= 12'(MAX_DIFFERENCE);
    end
  endgenerate
  function automatic [SUM_BITS-1:0] sum_of(input [WINDOW*12-1:0] values, input [WINDOW-1:0] counted);
    begin
      sum_of = '0;
      for (int k = 0; k < WINDOW; k = k + 1) sum_of = sum_of + (counted[k] ? SUM_BITS'(values[k*12 +: 12]) : '0);
    end
  endfunction
  function automatic [COUNT_BITS-1:0] number_of(input [WINDOW-1:0] counted);
    begin
      number_of = '0;
      for (int k = 0; k < WINDOW; k = k + 1) number_of = number_of + COUNT_BITS'(counted[k]);
    end
  endfunction
  function automatic [SUM_BITS-1:0] total_of(input [WINDOW*SUM_BITS-1:0] sums);
    begin
      total_of = '0;
      for (int k = 0; k < WINDOW; k = k + 1) total_of = total_of + sums[k*SUM_BITS +: SUM_BITS];
    end
  endfunction
  function automatic [COUNT_BITS-1:0] all_of(input [WINDOW*COUNT_BITS-1:0] numbers);
    begin
      all_of = '0;
      for (int k = 0; k < WINDOW; k = k + 1) all_of = all_of + numbers[k*COUNT_BITS +: COUNT_BITS];
    end
  endfunction

  // v / 2n as v * (floor(2^POINT / 2n) + 1) >> POINT, exact for all v < 2^POINT / 2n; the largest v is n * 8189.
  localparam int POINT = $clog2(2 * 8189 * PLACES * PLACES + 1);
  localparam int PRODUCT_BITS = SUM_BITS + 1 + POINT;
  reg [POINT-1:0] reciprocals [0:PLACES];
  initial begin
    reciprocals[0] = '0;
    for (int n = 1; n <= PLACES; n = n + 1) reciprocals[n] = POINT'((1 << POINT) / (2 * n) + 1);
  end
  wire [POINT-1:0] reciprocal = reciprocals[number_4];
  reg [PRODUCT_BITS-1:0] product_5;
  wire [PRODUCT_BITS-1:0] wide_dividend = PRODUCT_BITS'(dividend_4);
  wire [PRODUCT_BITS-1:0] wide_reciprocal = PRODUCT_BITS'(reciprocal);

  always_ff @(posedge clk) begin
    if (moves[0]) begin
      window_0 <= shifted;
      columns_0 <= columns_exist;
      rows_0 <= rows_exist;
    end
    if (moves[1]) begin
      counts_1 <= counts;
      values_1 <= window_0;
      centre_1 <= centre_0;
    end
    if (moves[2]) begin
      for (int k = 0; k < WINDOW; k = k + 1) begin
        sums_2[k*SUM_BITS +: SUM_BITS] <= sum_of(values_1[k*WINDOW*12 +: WINDOW*12], counts_1[k*WINDOW +: WINDOW]);
        numbers_2[k*COUNT_BITS +: COUNT_BITS] <= number_of(counts_1[k*WINDOW +: WINDOW]);
      end
      centre_2 <= centre_1;
    end
    if (moves[3]) begin
      sum_3 <= total_of(sums_2);
      number_3 <= all_of(numbers_2);
      centre_3 <= centre_2;
    end
    if (moves[4]) begin
      dividend_4 <= {sum_3, 1'b0} + (SUM_BITS + 1)'(number_3);
      number_4 <= number_3;
      centre_4 <= centre_3;
    end
    if (moves[5]) begin
      product_5 <= wide_dividend * wide_reciprocal;
      centre_5 <= centre_4;
    end
    if (moves[6]) mean_6 <= centre_5 == INVALID ? INVALID : product_5[POINT +: 12];
  end
  wire [LATENCY-1:0] late = moves >> 7;
  pass_registers #(.BITS(12), .STAGES(LATENCY - 7)) others (
    .clk(clk), .moves(late[(LATENCY > 7 ? LATENCY-8 : 0):0]), .in(mean_6), .out(out_disparity_data));
endmodule
