// SPDX-License-Identifier: Apache-2.0
// A chain from one clock to another and back:
//   source -0-> stage -1-> stage -2-> stage -3-> stage -4-> sink
//   clk_0 .............|clk_1 .................|clk_0 .........
module graph_two_clocks #(
    parameter int DEPTH = 2
) (
    input  logic       clk_0,
    input  logic       clk_1,
    input  logic       want_write,
    input  logic       want_read,
    output logic [4:0] wrote,     // by FIFO
    output logic [4:0] was_read,
    output logic       disorder
);
  logic [4:0] in_valid;
  logic [4:0] in_ready;
  logic [7:0] in_data[5];
  logic [4:0] out_valid;
  logic [4:0] out_ready;
  logic [7:0] out_data[5];
  logic [4:0] wrong;

  source source (.clk(clk_0), .want(want_write), .valid(in_valid[0]), .ready(in_ready[0]), .data(in_data[0]));
  fifo #(.KIND(0), .DEPTH(DEPTH)) fifo_0 (
      .clk(clk_0), .in_valid(in_valid[0]), .in_ready(in_ready[0]), .in_data(in_data[0]),
      .out_valid(out_valid[0]), .out_ready(out_ready[0]), .out_data(out_data[0]));
  fifo_asynchronous #(.DEPTH(DEPTH), .TO_READER(2), .TO_WRITER(2)) fifo_1 (
      .in_clk(clk_0), .in_valid(in_valid[1]), .in_ready(in_ready[1]), .in_data(in_data[1]),
      .out_clk(clk_1), .out_valid(out_valid[1]), .out_ready(out_ready[1]), .out_data(out_data[1]));
  fifo #(.KIND(1), .DEPTH(DEPTH)) fifo_2 (
      .clk(clk_1), .in_valid(in_valid[2]), .in_ready(in_ready[2]), .in_data(in_data[2]),
      .out_valid(out_valid[2]), .out_ready(out_ready[2]), .out_data(out_data[2]));
  fifo_asynchronous #(.DEPTH(DEPTH), .TO_READER(3), .TO_WRITER(3)) fifo_3 (
      .in_clk(clk_1), .in_valid(in_valid[3]), .in_ready(in_ready[3]), .in_data(in_data[3]),
      .out_clk(clk_0), .out_valid(out_valid[3]), .out_ready(out_ready[3]), .out_data(out_data[3]));
  fifo #(.KIND(2), .DEPTH(DEPTH)) fifo_4 (
      .clk(clk_0), .in_valid(in_valid[4]), .in_ready(in_ready[4]), .in_data(in_data[4]),
      .out_valid(out_valid[4]), .out_ready(out_ready[4]), .out_data(out_data[4]));

  stage #(.INTERVAL(1), .LATENCY(2)) stage_0 (
      .clk(clk_0), .in_valid(out_valid[0]), .in_ready(out_ready[0]), .in_data(out_data[0]),
      .out_valid(in_valid[1]), .out_ready(in_ready[1]), .out_data(in_data[1]), .disorder(wrong[0]));
  stage #(.INTERVAL(2), .LATENCY(1)) stage_1 (
      .clk(clk_1), .in_valid(out_valid[1]), .in_ready(out_ready[1]), .in_data(out_data[1]),
      .out_valid(in_valid[2]), .out_ready(in_ready[2]), .out_data(in_data[2]), .disorder(wrong[1]));
  stage #(.INTERVAL(1), .LATENCY(0)) stage_2 (
      .clk(clk_1), .in_valid(out_valid[2]), .in_ready(out_ready[2]), .in_data(out_data[2]),
      .out_valid(in_valid[3]), .out_ready(in_ready[3]), .out_data(in_data[3]), .disorder(wrong[2]));
  stage #(.INTERVAL(1), .LATENCY(4)) stage_3 (
      .clk(clk_0), .in_valid(out_valid[3]), .in_ready(out_ready[3]), .in_data(out_data[3]),
      .out_valid(in_valid[4]), .out_ready(in_ready[4]), .out_data(in_data[4]), .disorder(wrong[3]));
  sink sink (
      .clk(clk_0), .want(want_read), .valid(out_valid[4]), .ready(out_ready[4]), .data(out_data[4]),
      .disorder(wrong[4]));
  assign wrote = in_valid & in_ready;
  assign was_read = out_valid & out_ready;
  assign disorder = wrong != 0;
endmodule
