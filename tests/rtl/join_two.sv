// SPDX-License-Identifier: Apache-2.0
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
