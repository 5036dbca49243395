// SPDX-License-Identifier: Apache-2.0
// One register in the style of two processes: its next state is made in an always @*, which a simulator runs when an
// input changes, and not before.
module fifo_next_state (
    input  wire       clk,
    input  wire       rst,
    input  wire [7:0] s_axis_tdata,
    input  wire       s_axis_tvalid,
    output wire       s_axis_tready,
    output reg  [7:0] m_axis_tdata,
    output wire       m_axis_tvalid,
    input  wire       m_axis_tready
);
  reg full = 1'b0;
  reg next_full;

  assign s_axis_tready = !full;
  assign m_axis_tvalid = full;
  always @* next_full = full ? !m_axis_tready : s_axis_tvalid;
  always @(posedge clk) begin
    if (rst) full <= 1'b0;
    else full <= next_full;
    if (!full) m_axis_tdata <= s_axis_tdata;
  end
endmodule
