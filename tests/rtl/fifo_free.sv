// SPDX-License-Identifier: Apache-2.0
// FIFO with any whole delays: what is written at edge t can be read at t + WRITE_TO_READ, a place freed at t can
// be written at t + READ_TO_WRITE. Each side sees the other one's count of tokens that many edges late; with a
// delay of 0 it sees the transfer of the present cycle.
module fifo_free #(
    parameter int DEPTH = 2,
    parameter int WRITE_TO_READ = 1,
    parameter int READ_TO_WRITE = 1,
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
  localparam int PLACE = DEPTH > 1 ? $clog2(DEPTH) : 1;
  localparam int COUNT = $clog2(DEPTH + 1) + 1;
  logic [WIDTH-1:0] memory[DEPTH];
  logic [PLACE-1:0] tail = 0;
  logic [PLACE-1:0] head = 0;
  logic [COUNT-1:0] written = 0;  // tokens so far, modulo more than 2 * DEPTH
  logic [COUNT-1:0] read = 0;

  if (WRITE_TO_READ == 0) begin : fall_through
    // What is not taken cannot be handed on; an empty one takes everything where a read is seen in its cycle.
    assign out_valid = written != read || (in_valid && (READ_TO_WRITE == 0 || in_ready));
    assign out_data  = written != read ? memory[head] : in_data;
  end else begin : delayed_write
    logic [WRITE_TO_READ*COUNT-1:0] seen;
    assign seen[0+:COUNT] = written;
    assign out_valid = seen[(WRITE_TO_READ-1)*COUNT+:COUNT] != read;
    assign out_data  = memory[head];
    for (genvar i = 1; i < WRITE_TO_READ; ++i) begin : delay
      logic [COUNT-1:0] register = 0;
      always_ff @(posedge clk) register <= seen[(i-1)*COUNT+:COUNT];
      assign seen[i*COUNT+:COUNT] = register;
    end
  end

  if (READ_TO_WRITE == 0) begin : write_when_read
    assign in_ready = written - read != COUNT'(DEPTH) || (out_valid && out_ready);
  end else begin : delayed_read
    logic [READ_TO_WRITE*COUNT-1:0] seen;
    assign seen[0+:COUNT] = read;
    assign in_ready = written - seen[(READ_TO_WRITE-1)*COUNT+:COUNT] != COUNT'(DEPTH);
    for (genvar i = 1; i < READ_TO_WRITE; ++i) begin : delay
      logic [COUNT-1:0] register = 0;
      always_ff @(posedge clk) register <= seen[(i-1)*COUNT+:COUNT];
      assign seen[i*COUNT+:COUNT] = register;
    end
  end

  always_ff @(posedge clk) begin
    if (in_valid && in_ready) begin
      memory[tail] <= in_data;
      tail <= tail == PLACE'(DEPTH - 1) ? 0 : tail + 1;
      written <= written + 1;
    end
    if (out_valid && out_ready) begin
      head <= head == PLACE'(DEPTH - 1) ? 0 : head + 1;
      read <= read + 1;
    end
  end
endmodule
