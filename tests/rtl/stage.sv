// SPDX-License-Identifier: Apache-2.0
// A stage's control: it fires every INTERVAL cycles at most and hands on through LATENCY registers with a
// handshake each (0: in the cycle of the firing). Of each frame of PIXELS tokens it reads AHEAD before it
// writes the first one, and writes the last AHEAD after it has read them all.
//
// Its tokens are numbers: it expects 0, 1, 2, ... and writes the like. `disorder` rises, and stays, when it reads
// any other.
module stage #(
    parameter int INTERVAL = 1,
    parameter int LATENCY = 1,
    parameter int PIXELS = 1,
    parameter int AHEAD = 0,
    parameter int WIDTH = 8
) (
    input  logic             clk,
    input  logic             in_valid,
    output logic             in_ready,
    input  logic [WIDTH-1:0] in_data,
    output logic             out_valid,
    input  logic             out_ready,
    output logic [WIDTH-1:0] out_data,
    output logic             disorder
);
  localparam int PHASE = $clog2(PIXELS + AHEAD + 1);
  localparam int WAIT = $clog2(INTERVAL + 1);
  logic [PHASE-1:0] phase = 0;  // of the next firing: AHEAD read, PIXELS - AHEAD do both, AHEAD write
  logic [WAIT-1:0] busy = 0;    // cycles until the next firing can be
  logic [WIDTH-1:0] expected = 0;
  logic [WIDTH-1:0] number = 0;
  logic consumes;
  logic produces;
  logic wants;  // to fire, but for room
  logic room;
  logic fires;

  assign consumes = phase < PHASE'(PIXELS);
  assign produces = AHEAD == 0 || phase + 1 > PHASE'(AHEAD);
  assign wants = busy == 0 && (!consumes || in_valid);
  assign fires = wants && (!produces || room);
  assign in_ready = busy == 0 && consumes && (!produces || room);
  initial disorder = 0;

  always_ff @(posedge clk) begin
    if (fires) begin
      busy <= WAIT'(INTERVAL - 1);
      phase <= phase == PHASE'(PIXELS + AHEAD - 1) ? 0 : phase + 1;
      if (consumes) begin
        expected <= expected + 1;
        if (in_data != expected) disorder <= 1;
      end
      if (produces) number <= number + 1;
    end else if (busy != 0) begin
      busy <= busy - 1;
    end
  end

  if (LATENCY == 0) begin : direct
    assign room = out_ready;
    assign out_valid = wants && produces;
    assign out_data = number;
  end else begin : pipeline
    logic [LATENCY-1:0] full = 0;
    logic [LATENCY-1:0] moves;  // a register takes what is before it when it, or one after it, is empty
    logic [WIDTH-1:0] data[LATENCY];
    for (genvar i = 0; i < LATENCY; ++i) begin : place
      assign moves[i] = out_ready || full[LATENCY-1:i] != '1;
    end
    assign room = moves[0];
    assign out_valid = full[LATENCY-1];
    assign out_data = data[LATENCY-1];
    always_ff @(posedge clk) begin
      if (moves[0]) begin
        full[0] <= fires && produces;
        data[0] <= number;
      end
      for (int i = 1; i < LATENCY; ++i) begin
        if (moves[i]) begin
          full[i] <= full[i-1];
          data[i] <= data[i-1];
        end
      end
    end
  end
endmodule
