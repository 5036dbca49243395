// SPDX-License-Identifier: Apache-2.0
// Registered FIFO: what is written at edge t can be read at t+1, a place freed at t can be written at t+1.
module fifo_registered #(
    parameter int DEPTH = 2,
    parameter int WIDTH = 8
) (
    input  logic             clk,
    input  logic             in_valid,
    output logic             in_ready,
    input  logic [WIDTH-1:0] in_data,
    output logic             out_valid,
    input  logic             out_ready,
    output logic [WIDTH-1:0] out_data
);
  localparam int COUNT = $clog2(DEPTH + 1);
  localparam int PLACE = DEPTH > 1 ? $clog2(DEPTH) : 1;
  logic [WIDTH-1:0] memory[DEPTH];
  logic [COUNT-1:0] held = 0;
  logic [PLACE-1:0] tail = 0;
  logic [PLACE-1:0] head = 0;

  assign in_ready  = held != COUNT'(DEPTH);
  assign out_valid = held != 0;
  assign out_data  = memory[head];

  always_ff @(posedge clk) begin
    if (in_valid && in_ready) begin
      memory[tail] <= in_data;
      tail <= tail == PLACE'(DEPTH - 1) ? 0 : tail + 1;
    end
    if (out_valid && out_ready) head <= head == PLACE'(DEPTH - 1) ? 0 : head + 1;
    held <= held + COUNT'(in_valid && in_ready) - COUNT'(out_valid && out_ready);
  end
endmodule
