// SPDX-License-Identifier: Apache-2.0
// Reads when `want` is up and there is a token, and expects 0, 1, 2, ...: `disorder` rises, and stays, when some
// token has been lost, doubled or overtaken.
module sink #(
    parameter int WIDTH = 8
) (
    input  logic             clk,
    input  logic             want,
    input  logic             valid,
    output logic             ready,
    input  logic [WIDTH-1:0] data,
    output logic             disorder
);
  logic [WIDTH-1:0] expected = 0;
  initial disorder = 0;
  assign ready = want;
  always_ff @(posedge clk) begin
    if (valid && ready) begin
      expected <= expected + 1;
      if (data != expected) disorder <= 1;
    end
  end
endmodule
