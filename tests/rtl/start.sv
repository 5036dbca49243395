// SPDX-License-Identifier: Apache-2.0
// Becomes 1 after CYCLES rising edges.
module start #(
    parameter int CYCLES = 0
) (
    input  logic clk,
    output logic started
);
  if (CYCLES == 0) begin : at_once
    logic unused;
    assign unused  = clk;
    assign started = 1;
  end else begin : later
    localparam int BITS = $clog2(CYCLES + 1);
    logic [BITS-1:0] passed = 0;
    assign started = passed == BITS'(CYCLES);
    always_ff @(posedge clk) if (!started) passed <= passed + 1;
  end
endmodule
