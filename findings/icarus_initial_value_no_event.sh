#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# An `always @*` that reads registers with a value from their declaration (`reg full = 1'b0;`) does not run in Icarus Verilog 11.0
# (Debian's 11.0-1.1+b1) with -g2012 before one of them changes: its result is x, and once a clock edge takes it over, x for ever.
# With -g2005 it runs at time 0, and so does Verilator 5.006 (5.006-3). A public AXI-Stream register in two processes is dead in
# the one and right in the others, in a bench whose inputs have their first values from declarations too and stay so until reset is
# over. A value from an initial block, or a moment later, an always_comb and an assign are alike in all. Guessed before: that
# -g2005 and -g2012 are alike.
set -euo pipefail

install() {
  [[ $(dpkg-query -W -f '${Version}' "$1" 2>/dev/null || true) == "$2" ]] ||
    apt-get install -y --no-install-recommends "$1=$2" >/dev/null
}
install verilator 5.006-3
install iverilog 11.0-1.1+b1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat >bench.v <<'SV'
module bench;
  reg declared = 1'b0;
  reg begun;
  reg late;
  initial begun = 1'b0;
  initial #1 late = 1'b0;
  reg of_declared, of_begun, of_late;
  wire by_assign = !declared;
  always @* of_declared = !declared;
  always @* of_begun = !begun;
  always @* of_late = !late;
  initial #5 begin
    $display("declaration %b, initial block %b, a moment later %b, assign %b", of_declared, of_begun, of_late, by_assign);
    $finish;
  end
endmodule
SV
sed -e 's/wire by_assign = !declared;/logic by_comb; always_comb by_comb = !declared;/' -e 's/by_assign/by_comb/; s/assign %b/always_comb %b/' bench.v >comb.sv
expect() {
  grep -qxF "$2" "$1" || { echo "changed: $1 does not say: $2" && cat "$1" && exit 1; }
  echo "$1: $2"
}

iverilog -g2005 -o simulation bench.v && vvp simulation >icarus_2005
expect icarus_2005 "declaration 1, initial block 1, a moment later 1, assign 1"
iverilog -g2012 -o simulation bench.v && vvp simulation >icarus_2012
expect icarus_2012 "declaration x, initial block 1, a moment later 1, assign 1"
iverilog -g2012 -o simulation comb.sv && vvp simulation >icarus_comb
expect icarus_comb "declaration x, initial block 1, a moment later 1, always_comb 1"
verilator --binary --timing -Wno-fatal --top-module bench bench.v >log 2>&1
obj_dir/Vbench >verilator
expect verilator "declaration 1, initial block 1, a moment later 1, assign 1"
