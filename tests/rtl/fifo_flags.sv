// SPDX-License-Identifier: Apache-2.0
// A registered FIFO with the ports that FIFOs without a handshake have: enables, and flags that forbid them.
module fifo_flags #(
    parameter int DEPTH = 8,
    parameter int WIDTH = 8
) (
    input  logic             clk,
    input  logic             rst_n,
    input  logic [WIDTH-1:0] din,
    input  logic             wr_en,
    output logic             full,
    output logic [WIDTH-1:0] dout,
    input  logic             rd_en,
    output logic             empty
);
  localparam int COUNT = $clog2(DEPTH + 1);
  localparam int PLACE = DEPTH > 1 ? $clog2(DEPTH) : 1;
  logic [WIDTH-1:0] memory[DEPTH];
  logic [COUNT-1:0] held;
  logic [PLACE-1:0] tail;
  logic [PLACE-1:0] head;

  assign full  = held == COUNT'(DEPTH);
  assign empty = held == 0;

  always_ff @(posedge clk) begin
    if (!rst_n) begin
      held <= 0;
      tail <= 0;
      head <= 0;
    end else begin
      if (wr_en && !full) begin
        memory[tail] <= din;
        tail <= tail == PLACE'(DEPTH - 1) ? 0 : tail + 1;
      end
      if (rd_en && !empty) begin
        dout <= memory[head];
        head <= head == PLACE'(DEPTH - 1) ? 0 : head + 1;
      end
      held <= held + COUNT'(wr_en && !full) - COUNT'(rd_en && !empty);
    end
  end
endmodule
