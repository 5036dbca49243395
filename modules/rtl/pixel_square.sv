// SPDX-License-Identifier: Apache-2.0
// Rows of an image, of which the 2 x 2 pixels of any two columns and any two rows can be read at once: a block RAM each for the
// even and odd columns of the even and odd rows. Rows are numbered by the slot that they are in. Two that are read
// together are the same or neighbours (with the first slot behind the last one), and so are columns.
`timescale 1ns / 1ps
`default_nettype none

module pixel_square #(
  parameter int WIDTH = 640,  // px
  parameter int SLOTS = 80    // rows, even
) (
  input wire clk,
  input wire writes,
  input wire [15:0] column,
  input wire [15:0] slot,
  input wire [7:0] pixel,

  input wire [1:0] moves,  // of the register behind the addresses, and of the memories' outputs
  input wire [15:0] left_column,
  input wire [15:0] right_column,
  input wire [15:0] upper_slot,
  input wire [15:0] lower_slot,
  output wire [7:0] upper_left,  // two registers later
  output wire [7:0] upper_right,
  output wire [7:0] lower_left,
  output wire [7:0] lower_right
);
  localparam int COLUMNS = (WIDTH + 1) / 2;
  localparam int ROWS = SLOTS / 2;
  localparam int ADDRESS_BITS = $clog2(ROWS * COLUMNS);
  localparam int ROW_BITS = ROWS > 1 ? $clog2(ROWS) : 1;
  // First address of a row: a table, where a product would take a multiplier.
  reg [ADDRESS_BITS-1:0] first_of [0:(1 << ROW_BITS)-1];
  initial for (int i = 0; i < 1 << ROW_BITS; i = i + 1) first_of[i] = ADDRESS_BITS'(i * COLUMNS);

  wire [ROW_BITS-1:0] write_row = slot[ROW_BITS:1];
  wire [ADDRESS_BITS-1:0] write_at = first_of[write_row] + ADDRESS_BITS'(column[15:1]);
  wire [15:0] even_column = left_column[0] ? right_column : left_column;
  wire [15:0] odd_column = left_column[0] ? left_column : right_column;
  wire [15:0] even_slot = upper_slot[0] ? lower_slot : upper_slot;
  wire [15:0] odd_slot = upper_slot[0] ? upper_slot : lower_slot;

  wire [31:0] read;  // even, odd column of the even slot; of the odd one
  reg [3:0] odd_0;        // left and right column, upper and lower slot
  reg [3:0] odd_1;
  always_ff @(posedge clk) begin
    if (moves[0]) odd_0 <= {left_column[0], right_column[0], upper_slot[0], lower_slot[0]};
    if (moves[1]) odd_1 <= odd_0;
  end
  genvar i;
  generate
    for (i = 0; i < 4; i = i + 1) begin : bank
      reg [7:0] pixels [0:ROWS*COLUMNS-1];
      wire [15:0] column_here = i % 2 == 0 ? even_column : odd_column;
      wire [15:0] slot_here = i / 2 == 0 ? even_slot : odd_slot;
      wire [ROW_BITS-1:0] row_here = slot_here[ROW_BITS:1];
      wire writes_here = writes && column[0] == (i % 2 != 0) && slot[0] == (i / 2 != 0);
      reg [ADDRESS_BITS-1:0] read_at;
      reg [7:0] out;
      always_ff @(posedge clk) begin
        if (writes_here) pixels[write_at] <= pixel;
        if (moves[0]) read_at <= first_of[row_here] + ADDRESS_BITS'(column_here[15:1]);
        if (moves[1]) out <= pixels[read_at];
      end
      assign read[i*8 +: 8] = out;
    end
  endgenerate
  wire [7:0] even_left = odd_1[3] ? read[15:8] : read[7:0];
  wire [7:0] even_right = odd_1[2] ? read[15:8] : read[7:0];
  wire [7:0] odd_left = odd_1[3] ? read[31:24] : read[23:16];
  wire [7:0] odd_right = odd_1[2] ? read[31:24] : read[23:16];
  assign upper_left = odd_1[1] ? odd_left : even_left;
  assign upper_right = odd_1[1] ? odd_right : even_right;
  assign lower_left = odd_1[0] ? odd_left : even_left;
  assign lower_right = odd_1[0] ? odd_right : even_right;
endmodule
