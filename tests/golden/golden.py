#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every number, pixel and date of a set of runs, compared byte for byte with what was recorded.

    golden.py list                       the names of the cases
    golden.py check PROGRAM CASE...      compares; prints the lines that differ; exit 1 if any does
    golden.py record PROGRAM [CASE...]   writes CASE.txt anew (all, if none is named): look at the diff
    golden.py diff OLD NEW [CASE...]     runs two builds and prints every line that differs, digests spelt out

A line is a number of a JSON file ("timing.json performance/frame_rate = 100.26 frames/s"), the digest of another file, or
what a command printed. What differs between two runs of one program (its own time and memory) and between two builds
(revision, wording of descriptions) stays out. A record keeps the headline numbers as lines, and of each further group of numbers
one digest: `diff` with a build that gives the record says which number it is that differs.
"""
import difflib
import hashlib
import json
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent

# Of this computer, this build, or wording.
LEFT_OUT = {"run/version", "run/revision", "run/command", "run/wall_time", "run/speed", "run/peak_memory",
            "schema/version", "schema/configuration"}
# Groups of timing.json that a record keeps number by number.
HEADLINES = {"run", "input", "camera", "software", "performance", "latency", "limit", "memory", "energy", "quality",
             "deadlock"}
# Pictures hold legends and are packed by a library; their numbers are in the files beside them. Databases say when, and on
# which computer, a point was evaluated.
SKIPPED_FILES = {".png", ".gif", ".html", ".db"}

TIMING = ["run", "--timing-only", "--no-verdict"]
EIGHT = "matching.paths=w, nw, n, ne, e, sw, s, se"


def timing(*arguments):
    return [TIMING + ["--out", "out"] + list(arguments)]


def images(*arguments):
    return [["run", "--no-verdict", "--out", "out"] + list(arguments)]


def sets(*assignments):
    return [word for assignment in assignments for word in ("--set", assignment)]


# Name: the commands, in one folder; files appear in "out", what is printed counts too.
CASES = {
    "scene": images(),
    "scene_wide_range": images("--size", "320x240", "-d", "256"),
    "rectified_eight_paths_in_memory": images("--rectified", "--size", "160x128", "-d", "64", "--set", EIGHT,
                                              *sets("matching.path_storage=memory")),
    "rows_in_memory": images("--rectified", "--size", "192x96", "-d", "32", *sets("matching.path_storage=memory")),
    "tiles_with_images": images("--size", "640x160", "-d", "64",
                                *sets("tiles.limit=384", "matching.paths=w,nw,n,ne,e")),
    "filters_off": images("--size", "160x128", *sets("uniqueness.enabled=false", "consistency.enabled=false",
                                                     "texture.enabled=false", "speckle.iterations=0",
                                                     "gap_interpolation.enabled=false",
                                                     "noise_reduction.enabled=false")),
    "other_parameters": images("--size", "160x128",
                               *sets("matching.p1=3", "matching.p2=255", "matching.cost_weight=2",
                                     "matching.outside_cost=maximum", "matching.path_start=delay_line",
                                     "matching.disparity_offset=5", "census.window_width=7", "camera.format=mono12_packed",
                                     "link.color_output=true")),
    "sequence": [["scene", "--rectified", "--size", "160x128", "--frames", "3", "--out", "in"],
                 ["run", "--no-verdict", "--input", "in", "--out", "out"]],
    "fit": [["scene", "--size", "320x240", "--out", "in"],
            ["run", "--no-verdict", "--left", "in/left.png", "--right", "in/right.png", "--calibration", "in/calib.yml",
             "--fit", "--set", "rectification.window=21", "--out", "out"]],
    "map": [["scene", "--size", "320x240", "--out", "in"],
            ["map", "encode", "--calibration", "in/calib.yml", "--out", "out/lens.map"], ["map", "info", "out/lens.map"],
            ["map", "decode", "out/lens.map", "--out", "out/lens.yml"]],
    "wide_range_timing": timing("-d", "256"),
    "largest": timing("--size", "1856x1856", "--timing-frames", "3"),
    "early_starts_with_tiles": timing("--size", "1280x240", "-d", "64",
                                      *sets("camera.early_start_rows=64", "link.early_start_rows=64")),
    "faults": timing("--size", "320x240", *sets("camera.frame_rate=200", "camera.jitter_ns=20000",
                                                "camera.fault=missing_row", "camera.fault_every=3")),
    "exposure_and_skew": timing("--size", "320x240", *sets("camera.exposure_ns=3000000", "camera.skew_ns=200000",
                                                           "camera.overlap=false", "software.queue_frames=true")),
    "simple_bus": timing("--size", "320x240", *sets("memory.model=bus", "memory.arbitration=fixed_priority",
                                                    "memory.bytes_per_cycle=1")),
    "other_device": timing("--size", "320x240", *sets("memory.device=lpddr4-3200-x32", "memory.mapping=rbcg",
                                                      "memory_map.alignment=32768")),
    "no_link": timing("--size", "320x240", *sets("link.enabled=false", "streams.default_kind=block_ram")),
    "asynchronous_fifos": timing("--size", "160x128", *sets("streams.default_kind=asynchronous",
                                                            "streams.synchroniser_stages=3")),
    "eight_paths": timing("--size", "320x240", "--set", EIGHT),
    "slow_matcher": timing("--size", "160x128", *sets("matching.interval=2", "matching.recurrence_latency=5",
                                                      "matching.row_overhead=17", "census.latency=9")),
    "core_alone": timing("--rectified", "--preset", "core-alone", "--size", "320x240"),
    "core_alone_eight_paths": timing("--rectified", "--preset", "core-alone", "--size", "320x240", "--set", EIGHT),
    "xfopencv": timing("--rectified", "--preset", "xfopencv-sgbm", "--timing-frames", "3"),
    "stereobm": timing("--rectified", "--preset", "xilinx-stereobm", "--timing-frames", "3"),
    "fixed_margins": timing("--preset", "scenescan-pro-fixed-margins", "--size", "1280x96"),
    "one_frame": timing("--frames", "1", "--timing-frames", "1", "--size", "160x128"),
    "deadlock": [["run", "--size", "320x240", "--set", "streams.left_texture.depth=64", "--out", "out"]],
    "verdict": [["run", "--timing-only", "--size", "160x128", "--out", "out"]],
    "relax": [["run", "--timing-only", "--relax", "--size", "160x128", "-d", "64", "--out", "out", *sets(EIGHT)]],
    "vary": [["run", "--timing-only", "--vary", "streams.left_texture.depth=64,128,1500", "--vary",
              "matching.iterations=1,4", "--size", "160x128", "--out", "out"]],
    "validate": [["validate", "--json"]],
    "sensitivity": [["validate", "--sensitivity"]],
    "traces_of_rows": timing("--size", "160x128", "-d", "64", "--trace", "csv,json,vcd,perfetto"),
    "traces_of_tokens": timing("--size", "64x32", "-d", "32", "--trace", "csv,json,vcd,perfetto", "--trace-level",
                               "tokens", "--trace-from", "8"),
    "registers": [["registers", "--header"], ["registers"]],
    "configuration": [["config"], ["config", "--preset", "xfopencv-sgbm"]],
}


def scalars(tree, path=""):
    """(path, text) of each number or word of a JSON tree; a metric is one, with its unit."""
    if isinstance(tree, dict):
        if "value" in tree and "unit" in tree:
            window = f" ({tree['window']})" if tree.get("window") else ""
            yield path, f"{json.dumps(tree['value'])} {tree['unit']}".rstrip() + window
            return
        for name, child in tree.items():
            yield from scalars(child, f"{path}/{name}" if path else name)
    elif isinstance(tree, list):
        if all(not isinstance(entry, (dict, list)) for entry in tree):
            yield path, json.dumps(tree)
        else:
            for index, entry in enumerate(tree):
                yield from scalars(entry, f"{path}[{index}]")
    else:
        yield path, json.dumps(tree)


def json_lines(name, text):
    lines = [f"{name} {path} = {value}" for path, value in scalars(json.loads(text))
             if not any(path == out or path.endswith("/" + out) or path.startswith(out + " ") for out in LEFT_OUT)
             and not path.endswith("description")]
    return sorted(lines)


def digest(data):
    return f"{len(data)} B, SHA-256 {hashlib.sha256(data).hexdigest()[:32]}"


def group_of(line):
    """The group of a JSON file that a line belongs to, or None for a line that a record keeps."""
    name, _, rest = line.partition(".json ")
    if not rest or name.endswith("relaxations") or rest.split("/")[0].split(" ")[0] in HEADLINES:
        return None
    return f"{name}.json {'/'.join(rest.split(' ')[0].split('/')[:2]) if rest.startswith('st') else rest.split('/')[0].split('[')[0]}"


def condensed(lines):
    """The lines, those of a group as one digest."""
    kept, groups = [], {}
    for line in lines:
        group = group_of(line)
        if group is None:
            kept.append(line)
            continue
        if group not in groups:
            kept.append(group)
        groups.setdefault(group, []).append(line)
    return [f"{line}: {len(groups[line])} numbers, {digest(chr(10).join(groups[line]).encode())}" if line in groups
            else line for line in kept]


def file_lines(name, data):
    if name.endswith("trace.json"):  # the events; the head names the program's version
        return [f"{name}: {digest(b''.join(line for line in data.splitlines(True) if line.startswith(b'[')))}"]
    if name.endswith("trace.vcd"):
        return [f"{name}: {digest(data[data.index(b'$timescale'):])}"]
    if name.endswith(".json"):
        return json_lines(name, data.decode())
    return [f"{name}: {digest(data)}"]


def record(program, case):
    lines = []
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "out").mkdir()
        for arguments in CASES[case]:
            done = subprocess.run([program, *arguments], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True,
                                  text=True, check=False)
            lines.append(f"$ parallax {' '.join(arguments)}")
            # How long it takes depends on the computer.
            lines += [line for line in done.stderr.splitlines() if " minutes to go, " not in line]
            if "--json" in arguments:
                lines += json_lines("printed", done.stdout)
            else:
                lines += done.stdout.splitlines()
            lines.append(f"exit code {done.returncode}")
        for path in sorted((pathlib.Path(folder) / "out").rglob("*")):
            if path.is_file() and path.suffix not in SKIPPED_FILES and not path.name.startswith("."):
                lines += file_lines(str(path.relative_to(pathlib.Path(folder) / "out")), path.read_bytes())
    return lines


def unified(before, after, names):
    return "\n".join(difflib.unified_diff(before, after, *names, n=0, lineterm=""))


def main():
    if len(sys.argv) == 2 and sys.argv[1] == "list":
        print("\n".join(CASES))
        return 0
    builds = {"check": 1, "record": 1, "diff": 2}.get(sys.argv[1] if len(sys.argv) > 1 else "")
    if builds is None or len(sys.argv) < 2 + builds:
        print(__doc__, file=sys.stderr)
        return 2
    programs = [str(pathlib.Path(argument).resolve()) for argument in sys.argv[2:2 + builds]]
    failed = 0
    for case in sys.argv[2 + builds:] or list(CASES):
        now = record(programs[-1], case)
        file = HERE / f"{case}.txt"
        if sys.argv[1] == "record":
            file.write_text("\n".join(condensed(now)) + "\n")
            continue
        if sys.argv[1] == "diff":
            before, names = record(programs[0], case), programs
        else:
            before, now, names = file.read_text().splitlines(), condensed(now), ("recorded", "now")
        if now == before:
            print(f"{case}: equal, {len(now)} lines")
            continue
        failed += 1
        print(f"{case}: differs\n{unified(before, now, names)}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
