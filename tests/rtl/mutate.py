#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Breaks the reference circuits (modules/rtl), one small change at a time, and asks whether the test benches of `parallax vectors` and
`parallax compare` find it (mutants.py: the changes, and what each should look like).

  mutate.py PROGRAM [--of N] [CIRCUIT...]   every N-th mutant (1: all) of these circuits (all seven), and a table of what was found

A mutant is found when the test bench does not pass under random stalls. Exit code 1: a mutant that is not listed as equivalent lives, or
one that is was found. Needs Icarus Verilog; each mutant takes about a second.
"""
import argparse
import collections
import json
import os
import subprocess
import sys
import tempfile

from images import write_images
from mutants import BENCHES, MUTANTS, STAGES

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FOLDER = os.path.join(ROOT, "modules", "rtl")
SECONDS = 60


def run(command, folder):
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=SECONDS, check=False)
        return done.returncode, done.stdout + done.stderr
    except subprocess.TimeoutExpired:
        return 1, "FAIL: time is up"


class Bench:
    """The vectors of a circuit, and what runs it."""

    def __init__(self, program, circuit, number, folder):
        self.program, self.circuit, self.folder = program, circuit, os.path.join(folder, f"{circuit}_{number}")
        self.stage = STAGES.get(circuit, circuit)
        options, self.parameters = BENCHES[circuit][number]
        code, said = run([program, "vectors", "--stage", self.stage, *options.split(), "--out", self.folder, "-q"], folder)
        if code != 0:
            sys.exit(f"vectors of {circuit}: {said}")
        self.sources = {
            name: open(os.path.join(FOLDER, name), encoding="utf-8").read()
            for name in sorted(os.listdir(FOLDER))
            if name.endswith(".sv")
        }

    def passes(self, sources):
        """Whether the test bench passes with these sources, and what it says."""
        library = os.path.join(self.folder, "rtl")
        os.makedirs(library, exist_ok=True)
        for name, text in sources.items():
            with open(os.path.join(library, name), "w", encoding="utf-8") as file:
                file.write(text)
        bench = self.stage + "_tb"
        dut = f"-DDUT={self.circuit} #({self.parameters})"
        code, said = run(
            ["iverilog", "-g2012", "-s", bench, "-y", "rtl", "-Y", ".sv", dut, "-o", "sim", bench + ".sv"], self.folder
        )
        if code != 0:
            return None, said
        said = ""
        for arguments in (["+seed=3"], ["+seed=5", "+stall=140"]):
            code, said = run(["vvp", "-n", "sim", "+dump", "+timeout=3000", *arguments], self.folder)
            if code != 0 or "PASS" not in said:
                return False, said
        return True, said

    def compared(self):
        """What `parallax compare` says of the dump, as JSON; None if it sees no difference."""
        with open(os.path.join(self.folder, "manifest.json"), encoding="utf-8") as file:
            outputs = [each["name"] for each in json.load(file)["streams"] if each["direction"] == "out"]
        command = [self.program, "compare", "--vectors", ".", "--json"]
        for name in outputs:
            command += ["--dump", f"{name}={name}.dump"]
        code, said = run(command, self.folder)
        return json.loads(said) if code == 1 else None


def mutated(sources, mutant):
    text = sources[mutant.file]
    if text.count(mutant.old) < 1:
        sys.exit(f"{mutant.file} has no '{mutant.old}'")
    return {**sources, mutant.file: text.replace(mutant.old, mutant.new, 1)}


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("program")
    parser.add_argument("--of", type=int, default=1)
    parser.add_argument("circuits", nargs="*", default=[])
    options = parser.parse_intermixed_args()
    program = os.path.abspath(options.program)
    chosen = [m for m in MUTANTS if not options.circuits or m.circuit in options.circuits][:: options.of]
    counts = collections.Counter()
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        write_images(folder)
        benches = {}
        for mutant in chosen:
            if mutant.circuit not in benches:
                numbers = range(len(BENCHES[mutant.circuit]))
                benches[mutant.circuit] = [Bench(program, mutant.circuit, number, folder) for number in numbers]
                for bench in benches[mutant.circuit]:
                    if not bench.passes(bench.sources)[0]:
                        sys.exit(f"{mutant.circuit}: the test bench does not pass without a change")
            for bench in benches[mutant.circuit]:
                passed, said = bench.passes(mutated(bench.sources, mutant))
                if not passed:
                    break
            what = f"{mutant.circuit}: {mutant.file}: {mutant.old.strip()} -> {mutant.new.strip()}"
            if passed is None:
                sys.exit(f"{what}: does not compile\n{said}")
            if mutant.equivalent:
                counts["equivalent"] += 1
                if not passed:
                    wrong.append(f"{what}: found, though equivalent: {mutant.equivalent}")
                continue
            counts["mutants"] += 1
            if passed:
                wrong.append(f"{what}: lives")
                continue
            counts["found"] += 1
            tree = bench.compared()
            if mutant.pattern == {"handshake"}:  # the test bench names the port and the cycle
                named = any(text in said for text in ("withdrawn", "changes in cycle", "nothing has moved", "is unknown"))
                counts["handshakes"] += 1
                counts["handshakes named"] += named or tree is not None
                continue
            if tree is None:
                wrong.append(f"{what}: compare sees no difference; the test bench: {said.splitlines()[0]}")
                continue
            counts["compared"] += 1
            first = tree["first_difference"]
            place = all(first.get(key) == value for key, value in mutant.place.items())
            counts["places"] += bool(mutant.place)
            counts["places right"] += bool(mutant.place) and place
            right = tree["pattern"] in mutant.pattern
            counts["patterns right"] += right
            print(f"{'ok' if right and place else '- '} {what}: {tree['pattern']}, {first}, expected {sorted(mutant.pattern)} {mutant.place}")
    for name, number in counts.items():
        print(f"{name:20} {number}")
    for line in wrong:
        print(line)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
