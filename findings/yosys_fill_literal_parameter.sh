#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Yosys 0.23 (Debian's 0.23-6) makes 1 of '1 where that is the value of a parameter or localparam, however wide it is declared;
# in an assignment, a comparison or an initial value it is all ones, as the standard says everywhere. There is no message, so a
# mask that simulates as 8'hff is 8'h01 in the netlist. Icarus Verilog 11.0 reads all of them alike; {8{1'b1}} is alike in both.
# Guessed before: all ones everywhere, as a localparam has its width from its declaration.
set -euo pipefail

install() {
  [[ $(dpkg-query -W -f '${Version}' "$1" 2>/dev/null || true) == "$2" ]] ||
    apt-get install -y --no-install-recommends "$1=$2" >/dev/null
}
install yosys 0.23-6
install iverilog 11.0-1.1+b1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat >masks.sv <<'SV'
module masks #(parameter logic [7:0] WIDE = '1) (
  input wire [7:0] v,
  output wire [7:0] parameter_mask, output wire [7:0] local_mask, output wire [7:0] replicated_mask,
  output wire [7:0] direct_mask, output wire [7:0] initial_mask, output wire equal
);
  localparam logic [7:0] ALL = '1;
  localparam logic [7:0] REPLICATED = {8{1'b1}};
  reg [7:0] start = '1;
  assign parameter_mask = WIDE;
  assign local_mask = ALL;
  assign replicated_mask = REPLICATED;
  assign direct_mask = '1;
  assign initial_mask = start;
  assign equal = v == '1;
endmodule
SV
cat >bench.sv <<'SV'
module bench;
  wire [7:0] p, l, r, d, i;
  wire e;
  masks dut (.v(8'hff), .parameter_mask(p), .local_mask(l), .replicated_mask(r), .direct_mask(d), .initial_mask(i), .equal(e));
  initial begin
    #1 $display("parameter %h, localparam %h, replicated %h, assigned %h, initial %h, equal %b", p, l, r, d, i, e);
    $finish;
  end
endmodule
SV
expect() {
  grep -qxF "$2" "$1" || { echo "changed: $1 does not say: $2" && cat "$1" && exit 1; }
  echo "$1: $2"
}

iverilog -g2012 -o simulation bench.sv masks.sv && vvp simulation >source
expect source "parameter ff, localparam ff, replicated ff, assigned ff, initial ff, equal 1"
yosys -q -p 'read_verilog -sv masks.sv; hierarchy -top masks; proc; opt; write_verilog -noattr netlist.v' >messages 2>&1
[[ ! -s messages ]] || { echo "changed: yosys says" && cat messages && exit 1; }
iverilog -g2012 -o simulation bench.sv netlist.v && vvp simulation >netlist
expect netlist "parameter 01, localparam 01, replicated ff, assigned ff, initial ff, equal 1"
