// SPDX-License-Identifier: Apache-2.0
// One writer and two readers, who get each token in the same cycle.
module fork_two (
    input  logic in_valid,
    output logic in_ready,
    output logic a_valid,
    input  logic a_ready,
    output logic b_valid,
    input  logic b_ready
);
  assign in_ready = a_ready && b_ready;
  assign a_valid  = in_valid && b_ready;
  assign b_valid  = in_valid && a_ready;
endmodule

// Two writers and one reader, who takes a token of each in the same cycle.
module join_two (
    input  logic a_valid,
    output logic a_ready,
    input  logic b_valid,
    output logic b_ready,
    output logic out_valid,
    input  logic out_ready
);
  assign out_valid = a_valid && b_valid;
  assign a_ready = out_ready && b_valid;
  assign b_ready = out_ready && a_valid;
endmodule
