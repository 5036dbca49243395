#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Synthesises the reference circuits (modules/rtl) with yosys for a 7-series FPGA and counts cells.

  synthesise.py table               writes modules/rtl/SYNTHESIS.md: takes some minutes
  synthesise.py check NAME...       1 if the row NAME of that table does not come out again
  synthesise.py netlist NAME FILE   writes the row's netlist, with memories as Verilog arrays, for a simulation with
                                    yosys' xilinx/cells_sim.v, which has no model of block RAMs
"""
import glob
import os
import re
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FOLDER = os.path.join(ROOT, "modules", "rtl")
TABLE = os.path.join(FOLDER, "SYNTHESIS.md")

SMALL = {"WIDTH": 32, "HEIGHT": 16}
LARGE = {"WIDTH": 640, "HEIGHT": 480}
TWELVE = {"P": 4, "ITERATIONS": 3}
# name: circuit, parameters; a small one of each circuit is checked, and simulated, by the tests
CASES = {
    "census-small": ("census", SMALL),
    "census-640": ("census", LARGE),
    "census-640-9x7": ("census", {**LARGE, "WINDOW_WIDTH": 9, "WINDOW_HEIGHT": 7}),
    "matching-small": ("matching", {**SMALL, **TWELVE}),
    "matching-640-p4": ("matching", {**LARGE, "P": 4, "ITERATIONS": 8}),
    "matching-640-p8": ("matching", {**LARGE, "P": 8, "ITERATIONS": 4}),
    "matching-640-p16": ("matching", {**LARGE, "P": 16, "ITERATIONS": 2}),
    "subpixel-small": ("subpixel", {**SMALL, **TWELVE}),
    "subpixel-640-p8": ("subpixel", {**LARGE, "P": 8, "ITERATIONS": 4}),
    "subpixel-640-p32": ("subpixel", {**LARGE, "P": 32, "ITERATIONS": 4}),
    "uniqueness-small": ("uniqueness", {**SMALL, **TWELVE}),
    "uniqueness-640-p8": ("uniqueness", {**LARGE, "P": 8, "ITERATIONS": 4}),
    "uniqueness-640-p32": ("uniqueness", {**LARGE, "P": 32, "ITERATIONS": 4}),
    "rectification-small": ("rectification", {**SMALL, "WINDOW": 9, "OFFSET_BITS": 9}),
    "rectification-640-w9": ("rectification", {**LARGE, "WINDOW": 9, "OFFSET_BITS": 9}),
    "rectification-640-w79": ("rectification", LARGE),
    "noise_reduction-small": ("noise_reduction", SMALL),
    "noise_reduction-640": ("noise_reduction", LARGE),
    "noise_reduction-640-w5": ("noise_reduction", {**LARGE, "WINDOW": 5}),
    "median_3x3-small": ("median_3x3", SMALL),
    "median_3x3-640": ("median_3x3", LARGE),
}
# column: cells, as a regular expression
COLUMNS = {
    "LUT": r"LUT[1-6]|INV",
    "FF": r"FD[A-Z]*",
    "CARRY4": "CARRY4",
    "MUXF7/8": "MUXF[78]",
    "LUT RAM": r"RAM\d+[A-Z]\d*(_1)?",
    "SRL": r"SRL\w+",
    "RAMB18": "RAMB18E1",
    "RAMB36": "RAMB36E1",
    "DSP48": "DSP48E1",
}


WHOLE = ("",)
BUT_MEMORIES = ("-run begin:map_memory", "-run fine:check")


def yosys(circuit, parameters, parts, after):
    """Runs yosys and returns what it says of `after`. `parts`: of synth_xilinx, as options of its runs."""
    sources = " ".join(f"'{name}'" if " " in name else name for name in sorted(glob.glob(os.path.join(FOLDER, "*.sv"))))
    chosen = " ".join(f"-chparam {name} {value}" for name, value in parameters.items())
    with tempfile.NamedTemporaryFile("r", suffix=".txt") as said:
        script = (
            f"read_verilog -defer -sv {sources}; hierarchy -top {circuit} {chosen}; "
            + " ".join(f"synth_xilinx -noiopad -noclkbuf {part} -top {circuit};" for part in parts)
            + f" tee -o {said.name} {after}"
        )
        done = subprocess.run(["yosys", "-q", "-p", script], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"yosys: {done.stderr.strip() or done.stdout.strip()}")
        return said.read()


def row(name):
    """The line of the table."""
    circuit, parameters = CASES[name]
    said = yosys(circuit, parameters, WHOLE, "stat")
    if "=== design hierarchy ===" in said:
        said = said[said.index("=== design hierarchy ===") :]
    cells = {kind: int(number) for kind, number in re.findall(r"^ +([A-Z][A-Z0-9_]+) +(\d+)$", said, re.MULTILINE)}
    numbers = []
    for pattern in COLUMNS.values():
        numbers.append(str(sum(count for kind, count in cells.items() if re.fullmatch(pattern, kind))))
    chosen = ", ".join(f"{key} {value}" for key, value in parameters.items())
    return f"| {name} | {chosen} | " + " | ".join(numbers) + " |"


def table():
    version = subprocess.run(["yosys", "-V"], capture_output=True, text=True, check=True).stdout.split("(")[0].strip()
    lines = [
        "# What yosys makes of the reference circuits",
        "",
        f"Cells of the 7 series after `synth_xilinx` of {version}, without buffers for pins; written by "
        "`tests/rtl/synthesise.py table`. Other parameters are the defaults: latencies those of the model.",
        "",
        "| name | parameters | " + " | ".join(COLUMNS) + " |",
        "|---|---|" + "---|" * len(COLUMNS),
    ]
    for name in CASES:
        print(name, file=sys.stderr, flush=True)
        lines.append(row(name))
        with open(TABLE, "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")


def check(names):
    with open(TABLE, encoding="utf-8") as file:
        lines = file.read().splitlines()
    for name in names:
        new = row(name)
        if new not in lines:
            sys.exit(f"SYNTHESIS.md: has no such line: {new}")


def main():
    arguments = sys.argv[1:]
    if arguments == ["table"]:
        table()
    elif len(arguments) > 1 and arguments[0] == "check":
        check(arguments[1:])
    elif len(arguments) == 3 and arguments[0] == "netlist":
        circuit, parameters = CASES[arguments[1]]
        yosys(circuit, parameters, BUT_MEMORIES, f"write_verilog -noattr {arguments[2]}")
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
