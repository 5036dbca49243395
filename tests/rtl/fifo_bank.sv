// SPDX-License-Identifier: Apache-2.0
// FIFOs with one clock, of every kind and of every depth from 1 to 64, each alone between a source and a sink.
// Index: kind; bit: depth - 1.
module fifo_bank (
    input  logic        clk,
    input  logic [63:0] want_write[8],
    input  logic [63:0] want_read[8],
    output logic [63:0] wrote[8],
    output logic [63:0] was_read[8],
    output logic [63:0] disorder[8]
);
  // Those of number 3 are described by their offsets: these kinds have no name of their own.
  localparam int KIND[8] = '{0, 1, 2, 3, 3, 3, 0, 3};
  localparam int WRITE_TO_READ[8] = '{1, 0, 2, 1, 0, 3, 1, 6};
  localparam int READ_TO_WRITE[8] = '{1, 1, 1, 0, 0, 2, 1, 1};
  localparam int NOT_READY[8] = '{0, 0, 0, 0, 0, 0, 1, 9};  // cycles after the start

  for (genvar kind = 0; kind < 8; ++kind) begin : of_kind
    for (genvar i = 0; i < 64; ++i) begin : of_depth
      logic in_valid;
      logic in_ready;
      logic [7:0] in_data;
      logic out_valid;
      logic out_ready;
      logic [7:0] out_data;
      logic started;
      logic fifo_ready;
      fifo #(
          .KIND(KIND[kind]), .DEPTH(i + 1),
          .WRITE_TO_READ(WRITE_TO_READ[kind]), .READ_TO_WRITE(READ_TO_WRITE[kind])
      ) fifo (.clk, .in_valid(in_valid && started), .in_ready(fifo_ready), .in_data, .out_valid, .out_ready, .out_data);
      start #(.CYCLES(NOT_READY[kind])) start (.clk, .started);
      assign in_ready = fifo_ready && started;
      source source (.clk, .want(want_write[kind][i]), .valid(in_valid), .ready(in_ready), .data(in_data));
      sink sink (
          .clk, .want(want_read[kind][i]), .valid(out_valid), .ready(out_ready), .data(out_data),
          .disorder(disorder[kind][i]));
      assign wrote[kind][i] = in_valid && in_ready;
      assign was_read[kind][i] = out_valid && out_ready;
    end
  end
endmodule
