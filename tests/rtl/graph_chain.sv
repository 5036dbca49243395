// SPDX-License-Identifier: Apache-2.0
// Four stages of different interval and latency in a row, with FIFOs of different kinds between them:
//   source -0-> stage -1-> stage -2-> stage -3-> stage -4-> sink
module graph_chain #(
    parameter int DEPTH = 2
) (
    input  logic       clk,
    input  logic       want_write,
    input  logic       want_read,
    output logic [4:0] wrote,     // by FIFO
    output logic [4:0] was_read,
    output logic       disorder
);
  localparam int KIND[5] = '{0, 1, 2, 3, 0};
  localparam int INTERVAL[4] = '{1, 2, 1, 3};
  localparam int LATENCY[4] = '{3, 0, 1, 5};
  logic [4:0] in_valid;
  logic [4:0] in_ready;
  logic [7:0] in_data[5];
  logic [4:0] out_valid;
  logic [4:0] out_ready;
  logic [7:0] out_data[5];
  logic [4:0] wrong;

  source source (.clk, .want(want_write), .valid(in_valid[0]), .ready(in_ready[0]), .data(in_data[0]));
  for (genvar i = 0; i < 5; ++i) begin : link
    fifo #(.KIND(KIND[i]), .DEPTH(DEPTH), .WRITE_TO_READ(1), .READ_TO_WRITE(0)) fifo (
        .clk,
        .in_valid(in_valid[i]), .in_ready(in_ready[i]), .in_data(in_data[i]),
        .out_valid(out_valid[i]), .out_ready(out_ready[i]), .out_data(out_data[i]));
  end
  for (genvar i = 0; i < 4; ++i) begin : hop
    stage #(.INTERVAL(INTERVAL[i]), .LATENCY(LATENCY[i])) stage (
        .clk,
        .in_valid(out_valid[i]), .in_ready(out_ready[i]), .in_data(out_data[i]),
        .out_valid(in_valid[i+1]), .out_ready(in_ready[i+1]), .out_data(in_data[i+1]),
        .disorder(wrong[i]));
  end
  sink sink (
      .clk, .want(want_read), .valid(out_valid[4]), .ready(out_ready[4]), .data(out_data[4]), .disorder(wrong[4]));
  assign wrote = in_valid & in_ready;
  assign was_read = out_valid & out_ready;
  assign disorder = wrong != 0;
endmodule
