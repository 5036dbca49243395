// SPDX-License-Identifier: Apache-2.0
// One image of the rectification: the pixel at an offset of (dx, dy) from the place of the pixel written, between four
// neighbours, those outside the image replaced by the nearest inside (modules/rectification.hpp, rounding to nearest).
// Registers: the offset; the neighbours' places; their addresses; the pixels; these in order; two rows; their sum; the pixel.
`timescale 1ns / 1ps
`default_nettype none

module bilinear #(
  parameter int WIDTH = 640,
  parameter int HEIGHT = 480,
  parameter int SLOTS = 80,          // rows held, even, at least the window and one
  parameter int OFFSET_BITS = 12,
  parameter int FRACTION_BITS = 5,   // of an offset
  parameter int STAGES = 10          // registers, at least 8
) (
  input wire clk,
  input wire writes,  // a pixel of the image as it comes
  input wire [15:0] write_column,
  input wire [15:0] write_slot,
  input wire [7:0] pixel,

  input wire [STAGES-1:0] moves,
  input wire [15:0] column,  // of the pixel that comes out
  input wire [15:0] row,
  input wire [15:0] slot,    // where the image has this row
  input wire [OFFSET_BITS-1:0] dx,
  input wire [OFFSET_BITS-1:0] dy,
  output wire [7:0] out
);
  localparam int S = 1 << FRACTION_BITS;
  localparam int ROW_SUM = 8 + FRACTION_BITS;
  localparam int SQUARE_SUM = 8 + 2 * FRACTION_BITS;
  function automatic signed [17:0] place(input [15:0] at, input signed [OFFSET_BITS-1:0] offset);
    reg signed [OFFSET_BITS-1:0] whole;
    begin
      whole = offset >>> FRACTION_BITS;
      place = $signed({2'b00, at}) + 18'(whole);
    end
  endfunction
  function automatic [15:0] clamped(input signed [17:0] at, input [15:0] size);
    begin
      clamped = at[15:0];
      if (at[17]) clamped = 16'd0;
      else if (at[16:0] >= {1'b0, size}) clamped = size - 16'd1;
    end
  endfunction
  // The slot of a row, from that of the row written; they are less than SLOTS apart.
  function automatic [15:0] slot_of(input [15:0] of_row, input [15:0] this_row, input [15:0] this_slot);
    reg signed [17:0] at;
    begin
      at = $signed({2'b00, this_slot}) + $signed({2'b00, of_row}) - $signed({2'b00, this_row});
      if (at < 18'sd0) at = at + 18'(SLOTS);
      else if (at >= $signed(18'(SLOTS))) at = at - 18'(SLOTS);
      slot_of = at[15:0];
    end
  endfunction

  reg [15:0] column_0, row_0, slot_0;
  reg [OFFSET_BITS-1:0] dx_0, dy_0;
  wire [17:0] x;
  wire [17:0] y;
  assign x = place(column_0, dx_0);
  assign y = place(row_0, dy_0);
  wire [17:0] next_x = x + 18'd1;
  wire [17:0] next_y = y + 18'd1;
  wire [15:0] upper_row;
  wire [15:0] lower_row;
  assign upper_row = clamped(y, 16'(HEIGHT));
  assign lower_row = clamped(next_y, 16'(HEIGHT));
  reg [15:0] left_1, right_1, upper_1, lower_1;
  wire [7:0] upper_left, upper_right, lower_left, lower_right;
  wire [1:0] square_moves = moves[3:2];
  pixel_square #(.WIDTH(WIDTH), .SLOTS(SLOTS)) square (
    .clk(clk), .writes(writes), .column(write_column), .slot(write_slot), .pixel(pixel), .moves(square_moves),
    .left_column(left_1), .right_column(right_1), .upper_slot(upper_1), .lower_slot(lower_1), .upper_left(upper_left),
    .upper_right(upper_right), .lower_left(lower_left), .lower_right(lower_right));

  // Both fractions, from register to register.
  wire [2*FRACTION_BITS-1:0] fractions_0 = {dy_0[FRACTION_BITS-1:0], dx_0[FRACTION_BITS-1:0]};
  wire [2*FRACTION_BITS-1:0] fractions_3;
  reg [FRACTION_BITS-1:0] fx_4, fy_4, fy_5;
  wire [2:0] fraction_moves = moves[3:1];
  pass_registers #(.BITS(2 * FRACTION_BITS), .STAGES(3)) fractions (
    .clk(clk), .moves(fraction_moves), .in(fractions_0), .out(fractions_3));
  // (S - f) * a + f * b
  function automatic [ROW_SUM-1:0] mixed(input [7:0] a, input [7:0] b, input [FRACTION_BITS-1:0] f);
    reg [ROW_SUM-1:0] of_a;
    reg [ROW_SUM-1:0] of_b;
    begin
      of_a = ROW_SUM'(a) * (ROW_SUM'(S) - ROW_SUM'(f));
      of_b = ROW_SUM'(b) * ROW_SUM'(f);
      mixed = of_a + of_b;
    end
  endfunction
  reg [7:0] upper_left_4, upper_right_4, lower_left_4, lower_right_4;
  reg [ROW_SUM-1:0] upper_5, lower_5;
  reg [SQUARE_SUM-1:0] sum_6;
  reg [7:0] pixel_7;
  // A neighbour without weight may lie beyond the rows held.
  wire is_left = fractions_3[FRACTION_BITS-1:0] == '0;
  wire is_upper = fractions_3[FRACTION_BITS +: FRACTION_BITS] == '0;
  wire [7:0] upper_other = is_left ? upper_left : upper_right;
  wire [7:0] lower_other = is_left ? lower_left : lower_right;
  wire [SQUARE_SUM-1:0] weight_5 = SQUARE_SUM'(fy_5);
  wire [SQUARE_SUM:0] rounded = {1'b0, sum_6} + (SQUARE_SUM + 1)'(S * S / 2);
  always_ff @(posedge clk) begin
    if (moves[0]) begin
      column_0 <= column;
      row_0 <= row;
      slot_0 <= slot;
      dx_0 <= dx;
      dy_0 <= dy;
    end
    if (moves[1]) begin
      left_1 <= clamped(x, 16'(WIDTH));
      right_1 <= clamped(next_x, 16'(WIDTH));
      upper_1 <= slot_of(upper_row, row_0, slot_0);
      lower_1 <= slot_of(lower_row, row_0, slot_0);
    end
    if (moves[4]) begin
      upper_left_4 <= upper_left;
      upper_right_4 <= upper_other;
      lower_left_4 <= is_upper ? upper_left : lower_left;
      lower_right_4 <= is_upper ? upper_other : lower_other;
      fx_4 <= fractions_3[FRACTION_BITS-1:0];
      fy_4 <= fractions_3[FRACTION_BITS +: FRACTION_BITS];
    end
    if (moves[5]) begin
      upper_5 <= mixed(upper_left_4, upper_right_4, fx_4);
      lower_5 <= mixed(lower_left_4, lower_right_4, fx_4);
      fy_5 <= fy_4;
    end
    if (moves[6]) sum_6 <= SQUARE_SUM'(upper_5) * (SQUARE_SUM'(S) - weight_5) + SQUARE_SUM'(lower_5) * weight_5;
    if (moves[7]) pixel_7 <= rounded[2*FRACTION_BITS +: 8];
  end
  wire [STAGES-1:0] late = moves >> 8;
  pass_registers #(.BITS(8), .STAGES(STAGES - 8)) others (
    .clk(clk), .moves(late[(STAGES > 8 ? STAGES-9 : 0):0]), .in(pixel_7), .out(out));
endmodule
