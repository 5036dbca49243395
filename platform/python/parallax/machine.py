# SPDX-License-Identifier: Apache-2.0
"""A machine: a preset with keys set."""

import json
import os
from collections.abc import Mapping
from typing import Any, Dict, List, NamedTuple, Optional

from . import _core
from .errors import Deadlock, Error, UnknownKey
from .images import is_array, pairs
from .results import Run, run_of
from .words import assignments, encoded, input_words, machine_words


class Key(NamedTuple):
    """A configuration key as it is in effect, as `parallax config --docs` shows it."""

    name: str
    value: Any
    unit: str
    allowed: str
    documentation: str
    tag: str  #: S stated, D derived, I inferred, F fitted, C a choice
    source: str


def presets() -> Dict[str, str]:
    """The presets that come with the program, and those of PARALLAX_PRESET_PATH: name and description."""
    return dict(_core.presets())


class Machine(Mapping):
    """A preset with keys set; a mapping of all its keys to their values.

    preset: a name (see presets()) or the path of a .toml file. settings: keys to set. disparities: the disparity range,
    which sets matching.iterations. Raises UserError where these make no machine.
    """

    def __init__(self, preset: str = "scenescan-pro", settings: Optional[Mapping] = None, *,
                 disparities: Optional[int] = None):
        self._preset = os.fspath(preset)
        self._settings = {}
        self._disparities = disparities
        self._values = {}
        self._documented = None
        self.set(settings or {})

    @property
    def preset(self) -> str:
        """Name or path of the preset."""
        return self._preset

    @property
    def disparities(self) -> Optional[int]:
        """The disparity range that was asked for, if one was."""
        return self._disparities

    @property
    def settings(self) -> Dict[str, Any]:
        """The keys that were set, in order."""
        return dict(self._settings)

    def set(self, settings, value=None) -> None:
        """set(key, value), or set({key: value, ...}) for several that make sense together only.

        Raises UserError for an unknown key, a bad value or an impossible machine; then nothing is changed."""
        if isinstance(settings, str):
            settings = {settings: value}
        changed = {key: one for key, one in self._settings.items() if key not in settings}
        changed.update(settings)
        self._values = _core.load(self._preset, encoded(assignments(changed)), self._disparities)
        self._settings = changed
        self._documented = None

    __setitem__ = set

    def changed(self, settings: Mapping) -> "Machine":
        """Another machine, with these keys set too."""
        return Machine(self._preset, {**self._settings, **settings}, disparities=self._disparities)

    def key(self, name: str) -> Key:
        """A key with its unit, what it allows, what it means and where its value is from."""
        value = self[name]
        if self._documented is None:
            self._documented = json.loads(_core.document(self._preset, encoded(assignments(self._settings)), self._disparities))
        found = self._documented
        for part in name.split("."):
            found = found[part]
        return Key(name, value, found["unit"], found["allowed"], found["documentation"], found["tag"], found["source"])

    def __getitem__(self, name: str):
        if name not in self._values:
            raise UnknownKey(f"unknown key {name}; the nearest is {_core.nearest_key(name, list(self._values))}")
        return self._values[name]

    def __iter__(self):
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __repr__(self) -> str:
        settings = f", {self._settings}" if self._settings else ""
        disparities = "" if self._disparities is None else f", disparities={self._disparities}"
        return f"parallax.Machine({self._preset!r}{settings}{disparities})"

    def words(self) -> List[str]:
        """The machine as options of the program: `--preset`, `--set`, `--disparities`."""
        return machine_words(self._preset, self._settings, self._disparities)

    def run(self, left=None, right=None, *, size=None, seed=None, frames=None, verdict=True, keep=True, **options) -> Run:
        """Images through the machine: what `parallax run` does, as a Run.

        left, right: a path each, or an array of rows x columns, or of rows x columns x 3 (RGB) or 4 (RGBA), of uint8 or
        uint16; or a list of arrays each, a sequence. Without images: the built-in scene, of `size` (width, height) and `seed`.
        frames: at most so many of the input; so many of the scene.
        verdict: whether more runs find out what limits the machine.
        keep: whether Run.frames has the images; a long sequence with `out` can do without.
        options: any other option of `parallax run` by its name with _ for -, as out="folder", report=True, input="folder",
        calibration=["left.yaml", "right.yaml"], trace=["csv"], timing_frames=20. Sweeps and circuits are the program's alone.

        Raises UserError for bad input, Deadlock where the machine gets stuck, Error for other faults, and KeyboardInterrupt
        at once when Ctrl-C is pressed. Arrays without gaps are not copied, nor are those of the result."""
        arrays = pairs(left, right) if is_array(left) or is_array(right) else []
        if not arrays:
            options = {"left": left, "right": right, **options}
        words = input_words(options, size=size, seed=seed, frames=frames, verdict=verdict) + self.words()
        code, timing, said, planes, pages = _core.run(encoded(words), arrays, keep)
        run = run_of(code, timing, said, planes, pages)
        if run.status == "stuck":
            raise Deadlock(run.message, run)
        if code != 0:
            raise Error(run.message)
        return run

    def time(self, left=None, right=None, *, verdict=False, **options) -> Run:
        """The timing alone, `parallax run --timing-only`: to the last digit what run() says of time, much sooner.

        Parameters as of run(); of images only the size counts."""
        return self.run(left, right, verdict=verdict, timing_only=True, **options)
