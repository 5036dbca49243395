// SPDX-License-Identifier: Apache-2.0
// ROWS x COLUMNS pixels of a raster that is shifted by one pixel in each firing, the newest one lowest and rightmost:
// line buffers in one block RAM, and the columns in registers. Pixel (r, c) is at (c * ROWS + r) * BITS; 0, 0 is the top left
// one. `window` has the pixel that comes with this firing; it knows no borders, so that a row goes on with the next one.
`timescale 1ns / 1ps
`default_nettype none

module raster_window #(
  parameter int WIDTH = 640,   // px of a row, at least 2
  parameter int ROWS = 5,      // at least 3
  parameter int COLUMNS = 5,   // at least 2
  parameter int BITS = 8
) (
  input wire clk,
  input wire fires,
  input wire [BITS-1:0] pixel,
  output wire [ROWS*COLUMNS*BITS-1:0] window
);
  localparam int KEPT = (ROWS - 1) * BITS;
  localparam int COLUMN = ROWS * BITS;
  localparam int AT_BITS = $clog2(WIDTH);
  reg [KEPT-1:0] lines [0:WIDTH-1];  // rows above, the nearest one lowest
  reg [KEPT-1:0] above;                 // out of the memory, for the next firing
  reg [AT_BITS-1:0] at = '0;
  wire [AT_BITS-1:0] next = at == AT_BITS'(WIDTH - 1) ? '0 : at + 1'b1;
  reg [COLUMN*(COLUMNS-1)-1:0] held;
  wire [COLUMN-1:0] column;

  genvar r;
  generate
    for (r = 0; r < ROWS - 1; r = r + 1) begin : of_row
      assign column[r*BITS +: BITS] = above[(ROWS-2-r)*BITS +: BITS];
    end
  endgenerate
  assign column[(ROWS-1)*BITS +: BITS] = pixel;
  assign window = {column, held};

  always_ff @(posedge clk) begin
    if (fires) begin
      lines[at] <= {above[KEPT-BITS-1:0], pixel};
      above <= lines[next];
      at <= next;
      held <= window[COLUMN*COLUMNS-1:COLUMN];
    end
  end
endmodule
