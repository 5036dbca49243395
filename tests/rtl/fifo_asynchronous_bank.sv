// SPDX-License-Identifier: Apache-2.0
// FIFOs between two clocks, with 1 to 3 synchroniser stages and of every depth from 1 to 64, each alone between a
// source and a sink. Index: stages - 1; bit: depth - 1.
module fifo_asynchronous_bank (
    input  logic        clk_0,  // of the sources
    input  logic        clk_1,  // of the sinks
    input  logic [63:0] want_write[3],
    input  logic [63:0] want_read[3],
    output logic [63:0] wrote[3],
    output logic [63:0] was_read[3],
    output logic [63:0] disorder[3]
);
  for (genvar s = 0; s < 3; ++s) begin : of_stages
    for (genvar i = 0; i < 64; ++i) begin : of_depth
      logic in_valid;
      logic in_ready;
      logic [7:0] in_data;
      logic out_valid;
      logic out_ready;
      logic [7:0] out_data;
      fifo_asynchronous #(.DEPTH(i + 1), .STAGES(s + 1)) fifo (.in_clk(clk_0), .out_clk(clk_1), .*);
      source source (.clk(clk_0), .want(want_write[s][i]), .valid(in_valid), .ready(in_ready), .data(in_data));
      sink sink (
          .clk(clk_1), .want(want_read[s][i]), .valid(out_valid), .ready(out_ready), .data(out_data),
          .disorder(disorder[s][i]));
      assign wrote[s][i] = in_valid && in_ready;
      assign was_read[s][i] = out_valid && out_ready;
    end
  end
endmodule
