// SPDX-License-Identifier: Apache-2.0
// FIFO in a block RAM, whose clocked read port is the output register: what is written at edge t is fetched at
// t+1 and can be read at t+2. The token in the output register counts towards DEPTH.
module fifo_block_ram #(
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
  logic [COUNT-1:0] held = 0;    // in the RAM and in the output register
  logic [COUNT-1:0] stored = 0;  // in the RAM
  logic [PLACE-1:0] tail = 0;
  logic [PLACE-1:0] head = 0;
  logic fetch;

  assign in_ready = held != COUNT'(DEPTH);
  assign fetch = stored != 0 && (!out_valid || out_ready);
  initial out_valid = 0;

  always_ff @(posedge clk) begin
    if (in_valid && in_ready) begin
      memory[tail] <= in_data;
      tail <= tail == PLACE'(DEPTH - 1) ? 0 : tail + 1;
    end
    if (fetch) begin
      out_data <= memory[head];
      head <= head == PLACE'(DEPTH - 1) ? 0 : head + 1;
    end
    out_valid <= fetch || (out_valid && !out_ready);
    stored <= stored + COUNT'(in_valid && in_ready) - COUNT'(fetch);
    held <= held + COUNT'(in_valid && in_ready) - COUNT'(out_valid && out_ready);
  end
endmodule
