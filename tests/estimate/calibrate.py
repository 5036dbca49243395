#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Calibrates the resource estimates (platform/doc/estimates.md) on what yosys makes of the reference circuits.

  calibrate.py record [FAMILY...]  synthesises the cases that synthesised_cells.json lacks: all take some 45 minutes
  calibrate.py check FAMILY CIRCUIT NAME=VALUE...
                                   1 if that case's record does not come out again
  calibrate.py fit BUILD           fits the costs in platform/presets/devices/family/*.toml to the record, by
                                   least squares of relative errors, and brings the page's table up to date; BUILD
                                   has estimate_test, which says what each cost is multiplied by
"""
import json
import os
import re
import subprocess
import sys
import tempfile

import cases

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
RECORD = os.path.join(HERE, "synthesised_cells.json")
PAGE = os.path.join(ROOT, "platform", "doc", "estimates.md")
BEGIN, END = "<!-- calibration: begin -->\n", "<!-- calibration: end -->\n"
SYNTHESIS = {
    "7-series": "synth_xilinx -noiopad -noclkbuf",
    "ultrascale-plus": "synth_xilinx -family xcup -noiopad -noclkbuf",
    "ecp5": "synth_ecp5 -nowidelut",
}
FITTED = ("7-series", "ecp5")  # families with costs of their own
# What a cell takes of the device: LUTs of logic, of RAM, of shift registers, flip-flops, block RAMs, DSPs.
CELLS = {
    "7-series": [
        (r"LUT[1-6]|INV", "luts", 1),
        (r"RAM(32|64)M|RAM128X1D|RAM256X1S", "ram_luts", 4),
        (r"RAM(32|64)X1D|RAM128X1S", "ram_luts", 2),
        (r"RAM(32|64)X1S", "ram_luts", 1),
        (r"SRL\w+", "shift_luts", 1),
        (r"FD[A-Z]+", "registers", 1),
        (r"RAMB18E1", "block_rams", 1),
        (r"RAMB36E1", "block_rams", 2),
        (r"DSP48E1", "dsps", 1),
    ],
    "ultrascale-plus": [
        (r"LUT[1-6]|INV", "luts", 1),
        (r"RAM32M16|RAM64M8", "ram_luts", 8),
        (r"SRL\w+", "shift_luts", 1),
        (r"FD[A-Z]+", "registers", 1),
        (r"RAMB18E2", "block_rams", 1),
        (r"RAMB36E2", "block_rams", 2),
        (r"DSP48E2", "dsps", 1),
    ],
    "ecp5": [
        (r"LUT4", "luts", 1),
        (r"CCU2C", "luts", 2),
        (r"TRELLIS_DPR16X4", "ram_luts", 6),
        (r"TRELLIS_FF", "registers", 1),
        (r"DP16KD|PDPW16KD", "block_rams", 1),
        (r"MULT18X18D", "dsps", 1),
    ],
}


def sources(circuit):
    folder = os.path.join("tests", "rtl") if circuit.startswith("fifo_") else os.path.join("modules", "rtl")
    names = [f"{circuit}.sv"] if circuit.startswith("fifo_") else sorted(os.listdir(os.path.join(ROOT, folder)))
    return [os.path.join(ROOT, folder, name) for name in names if name.endswith(".sv")]


def synthesise(family, circuit, parameters):
    chosen = " ".join(f"-chparam {name} {value}" for name, value in parameters.items())
    with tempfile.NamedTemporaryFile("r", suffix=".txt") as said:
        script = (
            f"read_verilog -defer -sv {' '.join(sources(circuit))}; hierarchy -top {circuit} {chosen}; "
            f"{SYNTHESIS[family]} -top {circuit}; tee -o {said.name} stat"
        )
        done = subprocess.run(["yosys", "-q", "-p", script], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"yosys: {done.stderr.strip() or done.stdout.strip()}")
        text = said.read()
    if "=== design hierarchy ===" in text:
        text = text[text.index("=== design hierarchy ===") :]
    return counted(family, {kind: int(n) for kind, n in re.findall(r"^ +([A-Z]\w+) +(\d+)$", text, re.MULTILINE)})


def counted(family, cells):
    numbers = dict.fromkeys(("luts", "ram_luts", "shift_luts", "registers", "block_rams", "dsps"), 0)
    for kind, number in cells.items():
        for pattern, resource, units in CELLS[family]:
            if re.fullmatch(pattern, kind):
                numbers[resource] += units * number
    return numbers


def read_record():
    if not os.path.exists(RECORD):
        return []
    with open(RECORD, encoding="utf-8") as file:
        return json.load(file)


def write_record(rows):
    with open(RECORD, "w", encoding="utf-8") as file:
        file.write("[\n" + ",\n".join(json.dumps(row) for row in rows) + "\n]\n")


def record(families):
    known = {(row["family"], row["circuit"], json.dumps(row["parameters"], sort_keys=True)): row for row in read_record()}
    rows = []
    for family in families or SYNTHESIS:
        for circuit, parameters, use in cases.of_family(family):
            key = (family, circuit, json.dumps(parameters, sort_keys=True))
            row = known.pop(key, None)
            if row is None:
                print(family, circuit, parameters, file=sys.stderr, flush=True)
                row = {"family": family, "circuit": circuit, "parameters": parameters}
                row.update(synthesise(family, circuit, parameters))
            rows.append({**row, "use": use})
    write_record(rows + [row for (family, *_), row in known.items() if families and family not in families])


def check(family, circuit, assignments):
    parameters = {name: int(value) for name, value in (each.split("=") for each in assignments)}
    new = synthesise(family, circuit, parameters)
    for row in read_record():
        if (row["family"], row["circuit"], row["parameters"]) == (family, circuit, parameters):
            old = {name: row[name] for name in new}
            sys.exit(None if old == new else f"the record has {old}, and yosys makes {new}")
    sys.exit("the record has no such case")


def solve(matrix, right):
    """Gauss' elimination."""
    size = len(right)
    rows = [list(row) + [value] for row, value in zip(matrix, right)]
    for i in range(size):
        pivot = max(range(i, size), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for k in range(size):
            if k != i:
                factor = rows[k][i] / rows[i][i]
                rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i])]
    return [rows[i][size] / rows[i][i] for i in range(size)]


def least_squares(features, wanted):
    """Costs that are not negative: one that would be is left out, and is 0."""
    names = sorted({name for row in features for name, value in row.items() if value})
    while True:
        rows = [[row.get(name, 0) / max(1, want) for name in names] for row, want in zip(features, wanted)]
        square = [[sum(row[i] * row[j] for row in rows) for j in range(len(names))] for i in range(len(names))]
        right = [sum(row[i] for row in rows) for i in range(len(names))]
        costs = dict(zip(names, solve(square, right)))
        negative = [name for name in names if costs[name] < 0]
        if not negative:
            return costs
        names.remove(min(negative, key=costs.get))


def write_costs(family, costs, number):
    path = os.path.join(ROOT, "platform", "presets", "devices", "family", f"{family}.toml")
    with open(path, encoding="utf-8") as file:
        lines = file.read().splitlines(keepends=True)
    source = f"yosys 0.23, {SYNTHESIS[family]}: {number} cases of tests/estimate/cases.py"
    for i, line in enumerate(lines):
        name = line.split(" = ")[0]
        if 'tag = "F"' in line:
            lines[i] = f'{name} = {{ value = {costs.get(name, 0.0):.4g}, tag = "F", source = "{source}" }}\n'
            lines[i] = re.sub(r"value = (-?\d+),", r"value = \1.0,", lines[i])
    with open(path, "w", encoding="utf-8") as file:
        file.writelines(lines)


def ask(build, what):
    with tempfile.NamedTemporaryFile("r", suffix=".txt") as file:
        environment = {**os.environ, f"PARALLAX_CALIBRATION_{what}": file.name}
        subprocess.run(
            [os.path.join(build, "estimate_test"), "--gtest_filter=Calibration.*Asked*"],
            env=environment, check=False, stdout=subprocess.DEVNULL,
        )
        return file.read()


def fit(build):
    features = json.loads(ask(build, "FEATURES"))
    for family in FITTED:
        rows = [row for row in features if row["family"] == family and row["use"] == cases.CALIBRATE]
        costs = least_squares([row["features"] for row in rows], [row["luts"] - row["known"] for row in rows])
        write_costs(family, costs, len(rows))
    table = ask(build, "TABLE")
    if os.path.exists(PAGE):
        with open(PAGE, encoding="utf-8") as file:
            text = file.read()
        text = text[: text.index(BEGIN) + len(BEGIN)] + table + text[text.index(END) :]
        with open(PAGE, "w", encoding="utf-8") as file:
            file.write(text)


def main():
    arguments = sys.argv[1:]
    if arguments[:1] == ["record"] and all(name in SYNTHESIS for name in arguments[1:]):
        record(arguments[1:])
    elif arguments[:1] == ["check"] and len(arguments) > 2 and arguments[1] in SYNTHESIS:
        check(arguments[1], arguments[2], arguments[3:])
    elif arguments[:1] == ["fit"] and len(arguments) == 2:
        fit(arguments[1])
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
