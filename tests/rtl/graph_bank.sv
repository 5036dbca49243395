// SPDX-License-Identifier: Apache-2.0
// One graph with one clock 64 times, with all depths from 1 to 64. Index: FIFO; bit: depth - 1.
module graph_bank #(
    parameter int GRAPH = 0  // 0 chain, 1 fork and join, 2 join with a delay of two rows
) (
    input  logic        clk,
    input  logic [63:0] want_write[1],
    input  logic [63:0] want_read[1],
    output logic [63:0] wrote[5],
    output logic [63:0] was_read[5],
    output logic [63:0] disorder[1]
);
  for (genvar i = 0; i < 64; ++i) begin : of_depth
    logic [4:0] in;
    logic [4:0] out;
    if (GRAPH == 0) begin : chain
      graph_chain #(.DEPTH(i + 1)) graph (
          .clk, .want_write(want_write[0][i]), .want_read(want_read[0][i]), .wrote(in), .was_read(out),
          .disorder(disorder[0][i]));
    end else if (GRAPH == 1) begin : fork_join
      graph_fork_join #(.DEPTH(i + 1), .OTHERS(i + 1), .LATENCY(6)) graph (
          .clk, .want_write(want_write[0][i]), .want_read(want_read[0][i]), .wrote(in), .was_read(out),
          .disorder(disorder[0][i]));
    end else begin : row_delay
      graph_fork_join #(.DEPTH(i + 1), .OTHERS(4), .LATENCY(2), .PIXELS(5 * 12), .AHEAD(2 * 12)) graph (
          .clk, .want_write(want_write[0][i]), .want_read(want_read[0][i]), .wrote(in), .was_read(out),
          .disorder(disorder[0][i]));
    end
    for (genvar f = 0; f < 5; ++f) begin : of_fifo
      assign wrote[f][i] = in[f];
      assign was_read[f][i] = out[f];
    end
  end
endmodule
