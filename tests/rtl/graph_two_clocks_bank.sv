// SPDX-License-Identifier: Apache-2.0
// The chain over two clocks 64 times, with all depths from 1 to 64. Index: FIFO; bit: depth - 1.
module graph_two_clocks_bank (
    input  logic        clk_0,
    input  logic        clk_1,
    input  logic [63:0] want_write[1],
    input  logic [63:0] want_read[1],
    output logic [63:0] wrote[5],
    output logic [63:0] was_read[5],
    output logic [63:0] disorder[1]
);
  for (genvar i = 0; i < 64; ++i) begin : of_depth
    logic [4:0] in;
    logic [4:0] out;
    graph_two_clocks #(.DEPTH(i + 1)) graph (
        .clk_0, .clk_1, .want_write(want_write[0][i]), .want_read(want_read[0][i]), .wrote(in), .was_read(out),
        .disorder(disorder[0][i]));
    for (genvar f = 0; f < 5; ++f) begin : of_fifo
      assign wrote[f][i] = in[f];
      assign was_read[f][i] = out[f];
    end
  end
endmodule
