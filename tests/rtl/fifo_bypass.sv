// SPDX-License-Identifier: Apache-2.0
// FIFO in a RAM with an output register, into which a token goes past the RAM where nothing is before it. So one
// can be read after an edge where the FIFO is empty, after two where it is not: no constant delays describe it.
module fifo_bypass #(
    parameter int DEPTH = 4,
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
  logic [COUNT-1:0] stored = 0;
  logic [PLACE-1:0] tail = 0;
  logic [PLACE-1:0] head = 0;
  logic write;
  logic past;
  logic fetch;

  assign in_ready = stored != COUNT'(DEPTH);
  assign past     = in_valid && in_ready && stored == 0 && !out_valid;
  assign write    = in_valid && in_ready && !past;
  assign fetch    = stored != 0 && (!out_valid || out_ready);
  initial out_valid = 0;

  always_ff @(posedge clk) begin
    if (write) begin
      memory[tail] <= in_data;
      tail <= tail == PLACE'(DEPTH - 1) ? 0 : tail + 1;
    end
    if (fetch) begin
      out_data <= memory[head];
      head <= head == PLACE'(DEPTH - 1) ? 0 : head + 1;
    end
    if (past) out_data <= in_data;
    out_valid <= fetch || past || (out_valid && !out_ready);
    stored <= stored + COUNT'(write) - COUNT'(fetch);
  end
endmodule
