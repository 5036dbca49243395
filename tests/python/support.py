# SPDX-License-Identifier: Apache-2.0
"""The program, and what of its results is another each time."""

import os
import shlex
import subprocess

PROGRAM = os.environ["PARALLAX_PROGRAM"]
# Of a machine that takes some hundredths of a second.
SMALL = (96, 64)


def program(*words):
    """What the program says: its exit code, standard output and standard error."""
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def error_line(*words):
    """The line with which the program refuses something."""
    code, _, said = program(*words)
    assert code == 2, (code, said)
    return said.splitlines()[-1].replace("parallax: error: ", "", 1)


def repeated(run):
    """The words of the command that makes a run again."""
    return shlex.split(run["run/command"])[1:]


def lasting(timing):
    """timing.json without what is another each time."""
    timing = {**timing, "run": dict(timing["run"])}
    for name in ("wall_time", "speed", "peak_memory", "command"):
        del timing["run"][name]
    return timing


def packed(raw):
    """disparity.bin from its definition: two pixels of 12 bits in three bytes."""
    packed_bytes = bytearray()
    for row in raw.tolist():
        for one, two in zip(row[::2], row[1::2]):
            packed_bytes += bytes((one & 255, one >> 8 | (two & 15) << 4, two >> 4))
    return bytes(packed_bytes)
