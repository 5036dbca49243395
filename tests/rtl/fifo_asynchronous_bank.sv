// SPDX-License-Identifier: Apache-2.0
// FIFOs between two clocks, of every depth from 1 to 64, each alone between a source and a sink. Index: how many
// synchroniser stages each way, and cycles after the start in which it takes nothing; bit: depth - 1.
module fifo_asynchronous_bank (
    input  logic        clk_0,  // of the sources
    input  logic        clk_1,  // of the sinks
    input  logic [63:0] want_write[5],
    input  logic [63:0] want_read[5],
    output logic [63:0] wrote[5],
    output logic [63:0] was_read[5],
    output logic [63:0] disorder[5]
);
  localparam int TO_READER[5] = '{1, 2, 3, 6, 1};
  localparam int TO_WRITER[5] = '{1, 2, 3, 2, 4};
  localparam int NOT_READY[5] = '{0, 0, 0, 0, 5};

  for (genvar s = 0; s < 5; ++s) begin : of_stages
    for (genvar i = 0; i < 64; ++i) begin : of_depth
      logic in_valid;
      logic in_ready;
      logic [7:0] in_data;
      logic out_valid;
      logic out_ready;
      logic [7:0] out_data;
      logic started;
      logic fifo_ready;
      fifo_asynchronous #(.DEPTH(i + 1), .TO_READER(TO_READER[s]), .TO_WRITER(TO_WRITER[s])) fifo (
          .in_clk(clk_0), .in_valid(in_valid && started), .in_ready(fifo_ready), .in_data, .out_clk(clk_1), .out_valid,
          .out_ready, .out_data);
      start #(.CYCLES(NOT_READY[s])) start (.clk(clk_0), .started);
      assign in_ready = fifo_ready && started;
      source source (.clk(clk_0), .want(want_write[s][i]), .valid(in_valid), .ready(in_ready), .data(in_data));
      sink sink (
          .clk(clk_1), .want(want_read[s][i]), .valid(out_valid), .ready(out_ready), .data(out_data),
          .disorder(disorder[s][i]));
      assign wrote[s][i] = in_valid && in_ready;
      assign was_read[s][i] = out_valid && out_ready;
    end
  end
endmodule
