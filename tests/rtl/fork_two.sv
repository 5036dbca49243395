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
