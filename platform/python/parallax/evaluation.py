# SPDX-License-Identifier: Apache-2.0
"""Many machines, timed on all processors."""

from typing import Iterable, List, Mapping, Optional, Union

from . import _core
from .errors import UserError
from .images import is_array
from .machine import Machine
from .results import Run, point_of
from .words import encoded, input_words, machine_words


def evaluate(points: Iterable[Union[Mapping, Machine]], *, machine: Optional[Machine] = None, workers: Optional[int] = None,
             size=None, seed=None, frames=None, **options) -> List[Run]:
    """The timing of many points, as Machine.time() gives it, in their order: the results do not depend on `workers`.

    points: keys to set each, on top of `machine` (SceneScan Pro if not given); or machines. options: the input, as of
    Machine.run(): size, seed, frames, input, ... for all points. workers: processes; as many as there are processors, at
    most eight, if not given.

    What is wrong with a point is not raised: its Run has the status invalid, stuck or failed, with a message."""
    if workers is not None and workers < 1:
        raise UserError(f"workers is {workers}, allowed is 1 or more")
    if options.pop("verdict", False):
        raise UserError("evaluate() looks for no verdict: Machine.time(verdict=True) does, for one machine")
    base = Machine() if machine is None else machine
    for side in ("left", "right"):
        if is_array(options.get(side)):
            raise UserError(f"{side} is an array: evaluate() takes files; or their size, as images are not looked at")
    given = encoded(input_words({**options, "timing_only": True}, size=size, seed=seed, frames=frames, verdict=False))
    if isinstance(points, Mapping):
        raise UserError("evaluate() takes a list of points; this is one, a dictionary: [{...}]")
    words = [(given, encoded(_words(base, point))) for point in points]
    return [point_of(*result) for result in _core.evaluate(words, workers or 0)] if words else []


def _words(base, point):
    if isinstance(point, Machine):
        return point.words()
    if not isinstance(point, Mapping):
        raise UserError(f"evaluate() takes a list of points, each a dictionary of keys or a Machine; a point is {point!r}")
    settings = {key: value for key, value in base.settings.items() if key not in point}
    return machine_words(base.preset, {**settings, **point}, base.disparities)
