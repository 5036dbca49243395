// SPDX-License-Identifier: Apache-2.0
// A fork whose branches meet again, one of them through a stage that may look ahead:
//   source -0-> stage -+-1-> stage -3-+-> stage -4-> sink
//                      +------2-------+
module graph_fork_join #(
    parameter int DEPTH = 2,  // of FIFO 2
    parameter int OTHERS = 2, // of the other FIFOs
    parameter int LATENCY = 1,  // of the stage on the branch
    parameter int PIXELS = 1,  // of a frame
    parameter int AHEAD = 0
) (
    input  logic       clk,
    input  logic       want_write,
    input  logic       want_read,
    output logic [4:0] wrote,     // by FIFO
    output logic [4:0] was_read,
    output logic       disorder
);
  localparam int KIND[5] = '{1, 0, 2, 1, 3};
  logic [4:0] in_valid;
  logic [4:0] in_ready;
  logic [7:0] in_data[5];
  logic [4:0] out_valid;
  logic [4:0] out_ready;
  logic [7:0] out_data[5];
  logic [3:0] wrong;

  for (genvar i = 0; i < 5; ++i) begin : link
    fifo #(.KIND(KIND[i]), .DEPTH(i == 2 ? DEPTH : OTHERS), .WRITE_TO_READ(1), .READ_TO_WRITE(0)) fifo (
        .clk,
        .in_valid(in_valid[i]), .in_ready(in_ready[i]), .in_data(in_data[i]),
        .out_valid(out_valid[i]), .out_ready(out_ready[i]), .out_data(out_data[i]));
  end

  source source (.clk, .want(want_write), .valid(in_valid[0]), .ready(in_ready[0]), .data(in_data[0]));
  logic fork_valid;
  logic fork_ready;
  logic [7:0] fork_data;
  stage #(.LATENCY(1)) forking (
      .clk, .in_valid(out_valid[0]), .in_ready(out_ready[0]), .in_data(out_data[0]),
      .out_valid(fork_valid), .out_ready(fork_ready), .out_data(fork_data), .disorder(wrong[0]));
  assign in_data[1] = fork_data;
  assign in_data[2] = fork_data;
  fork_two fork_two (
      .in_valid(fork_valid), .in_ready(fork_ready),
      .a_valid(in_valid[1]), .a_ready(in_ready[1]), .b_valid(in_valid[2]), .b_ready(in_ready[2]));
  stage #(.LATENCY(LATENCY), .PIXELS(PIXELS), .AHEAD(AHEAD)) on_branch (
      .clk, .in_valid(out_valid[1]), .in_ready(out_ready[1]), .in_data(out_data[1]),
      .out_valid(in_valid[3]), .out_ready(in_ready[3]), .out_data(in_data[3]), .disorder(wrong[1]));
  logic join_valid;
  logic join_ready;
  join_two join_two (
      .a_valid(out_valid[3]), .a_ready(out_ready[3]), .b_valid(out_valid[2]), .b_ready(out_ready[2]),
      .out_valid(join_valid), .out_ready(join_ready));
  // Both tokens must have the number that is expected; a wrong one is handed on where it is not the first.
  stage #(.LATENCY(2)) joining (
      .clk, .in_valid(join_valid), .in_ready(join_ready),
      .in_data(out_data[2] == out_data[3] ? out_data[2] : ~out_data[2]),
      .out_valid(in_valid[4]), .out_ready(in_ready[4]), .out_data(in_data[4]), .disorder(wrong[2]));
  sink sink (
      .clk, .want(want_read), .valid(out_valid[4]), .ready(out_ready[4]), .data(out_data[4]), .disorder(wrong[3]));
  assign wrote = in_valid & in_ready;
  assign was_read = out_valid & out_ready;
  assign disorder = wrong != 0;
endmodule
