// SPDX-License-Identifier: Apache-2.0
// Census code of one image (modules/census.hpp: neighbour < centre, first neighbour in the highest bit, the nearest pixel
// outside the image): the window as it was shifted, its rows, its columns, the comparisons; a register each.
`timescale 1ns / 1ps
`default_nettype none

module census_image #(
  parameter int WIDTH = 640,
  parameter int WINDOW_WIDTH = 5,   // px, odd
  parameter int WINDOW_HEIGHT = 5,  // px, odd
  parameter int STAGES = 4          // registers, at least 4
) (
  input wire clk,
  input wire fires,
  input wire [7:0] pixel,
  input wire [WINDOW_WIDTH-1:0] columns_exist,  // of the pixel written
  input wire [WINDOW_HEIGHT-1:0] rows_exist,
  input wire [STAGES-1:0] moves,
  output wire [WINDOW_WIDTH*WINDOW_HEIGHT-2:0] code
);
  localparam int CODE_BITS = WINDOW_WIDTH * WINDOW_HEIGHT - 1;
  localparam int WINDOW_BITS = WINDOW_WIDTH * WINDOW_HEIGHT * 8;
  localparam int COLUMN = WINDOW_HEIGHT * 8;
  wire [WINDOW_BITS-1:0] shifted;
  raster_window #(.WIDTH(WIDTH), .ROWS(WINDOW_HEIGHT), .COLUMNS(WINDOW_WIDTH), .BITS(8)) pixels (
    .clk(clk), .fires(fires), .pixel(pixel), .window(shifted));

  reg [WINDOW_BITS-1:0] raw;
  reg [WINDOW_BITS-1:0] rows_right;
  reg [WINDOW_BITS-1:0] all_right;
  reg [WINDOW_WIDTH-1:0] raw_columns;
  reg [WINDOW_WIDTH-1:0] rows_right_columns;
  reg [WINDOW_HEIGHT-1:0] raw_rows;
  reg [CODE_BITS-1:0] compared;
  wire [WINDOW_BITS-1:0] with_rows;
  wire [WINDOW_BITS-1:0] with_columns;
  wire [CODE_BITS-1:0] comparisons;

  genvar i;
  generate
    for (i = 0; i < WINDOW_WIDTH; i = i + 1) begin : column
      nearest_in_image #(.REACH(WINDOW_HEIGHT / 2), .BITS(8)) rows (
        .in(raw[i*COLUMN +: COLUMN]), .exists(raw_rows), .out(with_rows[i*COLUMN +: COLUMN]));
    end
    nearest_in_image #(.REACH(WINDOW_WIDTH / 2), .BITS(COLUMN)) columns (
      .in(rows_right), .exists(rows_right_columns), .out(with_columns));
    for (i = 0; i < CODE_BITS; i = i + 1) begin : neighbour
      localparam int PLACE = i < CODE_BITS / 2 ? i : i + 1;  // in raster order; the centre is none
      localparam int AT = PLACE % WINDOW_WIDTH * WINDOW_HEIGHT + PLACE / WINDOW_WIDTH;
      localparam int CENTRE = WINDOW_WIDTH / 2 * WINDOW_HEIGHT + WINDOW_HEIGHT / 2;
      assign comparisons[CODE_BITS-1-i] = all_right[AT*8 +: 8] < all_right[CENTRE*8 +: 8];
    end
  endgenerate

  always_ff @(posedge clk) begin
    if (moves[0]) begin
      raw <= shifted;
      raw_columns <= columns_exist;
      raw_rows <= rows_exist;
    end
    if (moves[1]) begin
      rows_right <= with_rows;
      rows_right_columns <= raw_columns;
    end
    if (moves[2]) all_right <= with_columns;
    if (moves[3]) compared <= comparisons;
  end
  wire [STAGES-1:0] late = moves >> 4;
  wire [(STAGES > 4 ? STAGES-5 : 0):0] late_moves = late[(STAGES > 4 ? STAGES-5 : 0):0];
  pass_registers #(.BITS(CODE_BITS), .STAGES(STAGES - 4)) rest (
    .clk(clk), .moves(late_moves), .in(compared), .out(code));
endmodule
