// SPDX-License-Identifier: Apache-2.0
// A register slice of an AXI stream. TYPE 0: one register, ready when it is empty or emptied, in the same cycle; 1: one
// register, ready when it is empty; 2: two registers (a skid buffer), ready from a register. After reset, ready
// comes an edge late.
module fifo_register_slice #(
    parameter int TYPE  = 2,
    parameter int WIDTH = 8
) (
    input  logic             clk,
    input  logic             rst,
    input  logic [WIDTH-1:0] s_axis_tdata,
    input  logic             s_axis_tvalid,
    output logic             s_axis_tready,
    output logic [WIDTH-1:0] m_axis_tdata,
    output logic             m_axis_tvalid,
    input  logic             m_axis_tready
);
  logic started;
  logic takes;
  logic gives;
  logic full;  // the second register

  assign takes = s_axis_tvalid && s_axis_tready;
  assign gives = m_axis_tvalid && m_axis_tready;
  always_ff @(posedge clk) started <= !rst;

  if (TYPE == 2) begin : two
    logic [WIDTH-1:0] second;
    assign s_axis_tready = started && !full;
    always_ff @(posedge clk) begin
      if (takes) begin
        if (m_axis_tvalid && !gives) second <= s_axis_tdata;
        else m_axis_tdata <= s_axis_tdata;
      end
      if (gives && full) m_axis_tdata <= second;
      m_axis_tvalid <= !rst && (takes || full || (m_axis_tvalid && !gives));
      full <= !rst && !gives && (full || (takes && m_axis_tvalid));
    end
  end else begin : one
    assign full = 0;
    assign s_axis_tready = started && (!m_axis_tvalid || (TYPE == 0 && m_axis_tready));
    always_ff @(posedge clk) begin
      if (takes) m_axis_tdata <= s_axis_tdata;
      m_axis_tvalid <= !rst && (takes || (m_axis_tvalid && !gives));
    end
  end
endmodule
