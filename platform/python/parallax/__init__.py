# SPDX-License-Identifier: Apache-2.0
"""Parallax: a model of an FPGA that turns stereo image pairs into disparity maps.

    import parallax
    machine = parallax.Machine("scenescan-pro", {"clocks.core_hz": 150e6})
    run = machine.run(size=(640, 480))
    run["performance/frame_rate"]      # a metric of timing.json, by name
    run.disparity                      # float32, px; NaN where there is none

Machine: a preset with keys set. Machine.run() gives images and timing, Machine.time() the timing alone, both as a Run.
evaluate() times many machines on all processors, explore() finds the best of them, and estimate() says what one takes of
an FPGA. What is wrong is raised as UserError, Deadlock or Error, with the text
that the program `parallax` prints. `parallax config --docs` explains the keys, `parallax glossary` the metrics.

Each simulation has a process of its own, a copy of this one that runs no Python.
"""

from ._core import revision as __revision__
from ._core import version as __version__
from .errors import Deadlock, Error, UnknownKey, UserError
from .evaluation import evaluate
from .exploration import Exploration, estimate, explore
from .machine import Key, Machine, presets
from .results import CAUSES, Frame, Metric, Run

__all__ = [
    "CAUSES", "Deadlock", "Error", "Exploration", "Frame", "Key", "Machine", "Metric", "Run", "UnknownKey", "UserError",
    "estimate", "evaluate", "explore", "presets"
]
