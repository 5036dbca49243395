// SPDX-License-Identifier: Apache-2.0
// FIFO in a RAM with a clocked read port and PIPELINE registers behind it, which fill and empty as bubbles allow.
// Tokens in these registers do not count towards DEPTH: it holds DEPTH + PIPELINE + 1.
module fifo_ram_pipeline #(
    parameter int DEPTH = 8,
    parameter int PIPELINE = 1,
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
  logic [COUNT-1:0] stored = 0;  // in the RAM
  logic [PLACE-1:0] tail = 0;
  logic [PLACE-1:0] head = 0;
  logic [PIPELINE:0] valid = 0;
  logic [(PIPELINE+1)*WIDTH-1:0] data;
  logic [PIPELINE:0] moves;
  logic fetch;

  assign in_ready  = stored != COUNT'(DEPTH);
  assign out_valid = valid[PIPELINE];
  assign out_data  = data[PIPELINE*WIDTH+:WIDTH];
  assign fetch     = moves[0] && stored != 0;
  for (genvar i = 0; i <= PIPELINE; ++i) begin : stage
    assign moves[i] = out_ready || !(&valid[PIPELINE:i]);
  end

  always_ff @(posedge clk) begin
    if (in_valid && in_ready) begin
      memory[tail] <= in_data;
      tail <= tail == PLACE'(DEPTH - 1) ? 0 : tail + 1;
    end
    stored <= stored + COUNT'(in_valid && in_ready) - COUNT'(fetch);
    for (int i = PIPELINE; i > 0; --i) begin
      if (moves[i]) begin
        valid[i] <= valid[i-1];
        data[i*WIDTH+:WIDTH] <= data[(i-1)*WIDTH+:WIDTH];
      end
    end
    if (moves[0]) begin
      valid[0] <= fetch;
      data[0+:WIDTH] <= memory[head];
      if (fetch) head <= head == PLACE'(DEPTH - 1) ? 0 : head + 1;
    end
  end
endmodule
