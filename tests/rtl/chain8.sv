// SPDX-License-Identifier: Apache-2.0
// Eight stages at interval 1 with a registered FIFO before each and after the last, between a source that writes
// whenever `want_write` is up and a sink that reads whenever `want_read` is up.
module chain8 #(
    parameter int DEPTH = 2,
    parameter int WIDTH = 8
) (
    input  logic clk,
    input  logic want_write,
    input  logic want_read,
    output logic wrote,     // the source writes in this cycle
    output logic was_read,  // the sink reads in this cycle
    output logic disorder   // some token has been lost, doubled or overtaken
);
  localparam int STAGES = 8;
  logic [STAGES:0] in_valid;
  logic [STAGES:0] in_ready;
  logic [WIDTH-1:0] in_data[STAGES+1];
  logic [STAGES:0] out_valid;
  logic [STAGES:0] out_ready;
  logic [WIDTH-1:0] out_data[STAGES+1];
  logic [STAGES:0] wrong;

  source #(.WIDTH(WIDTH)) source (
      .clk, .want(want_write), .valid(in_valid[0]), .ready(in_ready[0]), .data(in_data[0]));
  for (genvar i = 0; i <= STAGES; ++i) begin : link
    fifo_registered #(.DEPTH(DEPTH), .WIDTH(WIDTH)) fifo (
        .clk,
        .in_valid(in_valid[i]), .in_ready(in_ready[i]), .in_data(in_data[i]),
        .out_valid(out_valid[i]), .out_ready(out_ready[i]), .out_data(out_data[i]));
  end
  for (genvar i = 0; i < STAGES; ++i) begin : hop
    stage #(.INTERVAL(1), .LATENCY(1), .WIDTH(WIDTH)) stage (
        .clk,
        .in_valid(out_valid[i]), .in_ready(out_ready[i]), .in_data(out_data[i]),
        .out_valid(in_valid[i+1]), .out_ready(in_ready[i+1]), .out_data(in_data[i+1]),
        .disorder(wrong[i]));
  end
  sink #(.WIDTH(WIDTH)) sink (
      .clk, .want(want_read), .valid(out_valid[STAGES]), .ready(out_ready[STAGES]), .data(out_data[STAGES]),
      .disorder(wrong[STAGES]));
  assign wrote = in_valid[0] && in_ready[0];
  assign was_read = out_valid[STAGES] && out_ready[STAGES];
  assign disorder = wrong != 0;
endmodule
