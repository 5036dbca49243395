# SPDX-License-Identifier: Apache-2.0
"""What a run gives."""

import json
import os
from typing import Any, Dict, Iterator, NamedTuple, Tuple

from . import _core
from .errors import Error, UnknownKey, UserError

#: What the numbers in Frame.causes mean.
CAUSES: Tuple[str, ...] = _core.causes


class Metric(NamedTuple):
    """A number (or word) of timing.json, with all that a reader needs to understand it."""

    name: str
    value: Any
    unit: str
    description: str
    window: str  #: over what it was measured, as "frames 10 to 11"; or empty


class Frame:
    """The images of one frame, of the size of those that went in.

    Its arrays lie in memory that the simulation wrote; that of a run is given back when none of its arrays is in use."""

    def __init__(self, planes: dict, pages):
        import numpy

        def plane(name, dtype):
            if planes[name] is None:
                return None
            shape = planes["height"], planes["width"]
            return numpy.frombuffer(pages, dtype, shape[0] * shape[1], planes[name]).reshape(shape)

        self.index: int = planes["index"]  #: of the frame, from 0
        self.raw = plane("disparities", numpy.uint16)  #: as the machine has them: 1/16 px, 4095 where there is none
        self.causes = plane("causes", numpy.uint8)  #: why there is none, or what changed it: an index of CAUSES
        self.left_rectified = plane("left", numpy.uint8)  #: the rectified left image, as the host receives it
        self.right_rectified = plane("right", numpy.uint8)  #: the rectified right image, which the machine keeps to itself
        self.truth = plane("truth", numpy.float32)  #: true disparities, px, 0 = unknown; None if there is no ground truth
        self.mask = plane("mask", numpy.uint8)  #: 255 where the truth counts; None: everywhere

    @property
    def valid(self):
        """Where there is a disparity: an array of bool, made anew each time."""
        return self.raw != _core.invalid

    @property
    def disparity(self):
        """Disparities, px: an array of float32, NaN where there is none, made anew each time."""
        import numpy

        return numpy.where(self.valid, self.raw / numpy.float32(16), numpy.float32(numpy.nan))

    def score(self, truth=None, mask=None) -> Dict[str, float]:
        """How the disparities compare with true ones, by the names that the numbers have in timing.json ("quality/bad_1").

        truth: px, 0 or no finite number = unknown; that of the frame if not given. mask: 255, or True, where it counts."""
        import numpy

        if truth is None:
            truth, mask = self.truth, self.mask if mask is None else mask
        if truth is None:
            raise UserError("this frame has no ground truth: give one")
        known = numpy.nan_to_num(numpy.array(truth, numpy.float32), nan=0, posinf=0, neginf=0)
        if mask is not None:
            mask = numpy.asarray(mask)
            counts = mask if mask.dtype == bool else mask == 255
            mask = numpy.where(counts, numpy.uint8(255), numpy.uint8(0))
        for name, array in (("truth", known), ("mask", mask)):
            if array is not None and array.shape != self.raw.shape:
                raise UserError(f"{name} has the shape {array.shape}, the disparities have {self.raw.shape}")
        known[known < 0] = 0
        return _core.score(numpy.ascontiguousarray(self.raw), known, mask)

    def __repr__(self) -> str:
        return f"<parallax.Frame {self.index}: {self.raw.shape[1]} x {self.raw.shape[0]} px>"


class Run:
    """What a run gives: run["performance/frame_rate"] is a metric by its name, run.disparity an image of the first frame."""

    def __init__(self, status: str, message: str, notes, timing: bytes, frames=()):
        self.status: str = status  #: done, stuck, invalid or failed; raised unless evaluate() gives it
        self.message: str = message  #: what is wrong; empty when done
        self.notes: Tuple[str, ...] = tuple(notes)  #: what the program says of the input, a line each
        self.frames: Tuple[Frame, ...] = tuple(frames)  #: in order; none of a run of which the timing alone was wanted
        self._text = timing
        self._timing = None

    @property
    def timing(self) -> dict:
        """What timing.json holds: a metric is a dictionary of value, unit, description and window."""
        if self._timing is None:
            self._timing = json.loads(self._text) if self._text else {}
        return self._timing

    @property
    def done(self) -> bool:
        """Whether the run came to its end."""
        return self.status == "done"

    def metric(self, name: str) -> Metric:
        """A metric by its name, "memory/row_hits". Raises UnknownKey, a KeyError, where the run has none of this name."""
        found = self.timing
        for part in name.split("/"):
            found = found.get(part, {}) if isinstance(found, dict) else {}
        if not isinstance(found, dict) or "value" not in found:
            why = "" if self.done else f", as it is {self.status}: {self.message}"
            raise UnknownKey(f"the run has no metric {name}{why}")
        return Metric(name, found["value"], found["unit"], found["description"], found.get("window", ""))

    def __getitem__(self, name: str):
        return self.metric(name).value

    def metrics(self) -> Dict[str, Any]:
        """All metrics: names and values."""
        return dict(_flat(self.timing))

    def frame(self, index: int = 0) -> Frame:
        """A frame with its images. Raises Error where there is none."""
        if index >= len(self.frames):
            raise Error(f"the run has {len(self.frames)} frames with images; time() and keep=False keep none")
        return self.frames[index]

    disparity = property(lambda self: self.frame().disparity, doc="Of the first frame: Frame.disparity.")
    raw = property(lambda self: self.frame().raw, doc="Of the first frame: Frame.raw.")
    valid = property(lambda self: self.frame().valid, doc="Of the first frame: Frame.valid.")
    causes = property(lambda self: self.frame().causes, doc="Of the first frame: Frame.causes.")
    left_rectified = property(lambda self: self.frame().left_rectified, doc="Of the first frame: Frame.left_rectified.")
    right_rectified = property(lambda self: self.frame().right_rectified, doc="Of the first frame: Frame.right_rectified.")

    def __repr__(self) -> str:
        what = f"{len(self.frames)} frames with images" if self.done else self.message
        return f"<parallax.Run {self.status}: {what}>"


def _flat(tree: dict, prefix: str = "") -> Iterator[Tuple[str, Any]]:
    for name, below in tree.items():
        if not isinstance(below, dict) or name == "configuration" and not prefix:
            continue
        if "value" in below and "unit" in below:
            yield prefix + name, below["value"]
        else:
            yield from _flat(below, f"{prefix}{name}/")


def run_of(code: int, timing: bytes, said: bytes, planes, pages) -> Run:
    """A run from what the libraries say of it; `said` is what the program would say on standard error."""
    notes, _, message = os.fsdecode(said).partition("parallax: error: ")
    lines = [line.replace("parallax: note: ", "", 1) for line in notes.splitlines()]
    frames = [Frame(one, pages) for one in planes]
    status = "done" if code == 0 else "stuck" if code == 1 else "failed"
    return Run(status, message.rstrip("\n") or ("" if code == 0 else "\n".join(lines)), lines, timing, frames)


def point_of(status: str, message: bytes, notes, timing: bytes) -> Run:
    """The same of one of many points."""
    return Run(status, os.fsdecode(message).rstrip("\n"), [os.fsdecode(line) for line in notes], timing)
