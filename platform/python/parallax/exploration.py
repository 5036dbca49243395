# SPDX-License-Identifier: Apache-2.0
"""Explorations: many machines, and the best of them."""

import csv
import json
import os
import re
import tempfile
from typing import Any, Dict, List, Mapping, Optional, Union

from . import _core
from .errors import Error, UserError
from .machine import Machine
from .words import encoded, machine_words, option_words


class Exploration:
    """What an exploration came to: exploration["performance/frame_rate"] is a column, an array with a value for each point.

    Columns are what varies, the numbers (NaN where a point has none), "point", "status", "satisfied", "front", "limit",
    "configuration", "command" and "message"."""

    def __init__(self, summary: dict, rows: List[List[str]]):
        self.summary: dict = summary  #: what `parallax explore --json` prints
        self.units: Dict[str, str] = {}  #: of the numbers
        self._columns: Dict[str, List[str]] = {}
        for index, title in enumerate(rows[0]):
            name, unit = re.fullmatch(r"(.*?)(?: \((.*)\))?", title).groups()
            if unit:
                self.units[name] = unit
            self._columns[name] = [row[index] for row in rows[1:]]

    @property
    def columns(self) -> List[str]:
        """Names of the columns."""
        return list(self._columns)

    def __getitem__(self, name: str):
        """A column by its name, an array of NumPy: numbers where all its values are, or else texts; bool for yes and no."""
        import numpy

        if name not in self._columns:
            raise UserError(f"the exploration has no column {name}: {', '.join(self._columns)}")
        texts = self._columns[name]
        if name in ("satisfied", "front"):
            return numpy.array([text == "yes" for text in texts])
        try:
            return numpy.array([float(text) if text else numpy.nan for text in texts]) if any(texts) else numpy.array(texts)
        except ValueError:
            return numpy.array(texts)

    def __len__(self) -> int:
        """How many points there are."""
        return len(self._columns["point"])

    @property
    def front(self) -> List[Dict[str, Any]]:
        """The best points, each as a dictionary of its columns."""
        chosen = [index for index, best in enumerate(self["front"]) if best]
        columns = {name: self[name] for name in self._columns}
        return [{name: column[index].item() for name, column in columns.items()} for index in chosen]

    def __repr__(self) -> str:
        return f"<parallax.Exploration: {len(self)} points, {int(self['front'].sum())} on the front>"


def explore(spec: Union[str, os.PathLike, Mapping], out: Optional[Union[str, os.PathLike]] = None) -> Exploration:
    """Times the machines of a specification on all processors, and says which are the best.

    spec: the file that `parallax explore` takes, or a dictionary of the same form:
    {"vary": {"clocks.core_hz": [1e8, 2e8]}, "objectives": {"energy/frame_total": "least"}}.
    out: folder for the results, in which points that it knows are not evaluated again; none is kept if not given.

    That no point satisfies the constraints is no error: `front` is empty then, and summary["nearest"] is the nearest. Raises
    UserError with the program's text. Ctrl-C ends it; what was evaluated is in `out`."""
    with tempfile.TemporaryDirectory() as folder:
        if isinstance(spec, Mapping):
            path = os.path.join(folder, "exploration.toml")
            with open(path, "w", encoding="utf-8") as file:
                file.write(toml_text(spec))
        else:
            path = os.fspath(spec)
        kept = os.path.join(folder, "out") if out is None else os.fspath(out)
        summary = json.loads(_said("explore", path, "--out", kept, "--json"))
        with open(os.path.join(kept, "points.csv"), newline="", encoding="utf-8", errors="surrogateescape") as file:
            return Exploration(summary, list(csv.reader(file)))


def estimate(machine: Optional[Machine] = None, *, device: Optional[str] = None, size=None) -> dict:
    """What a machine takes of an FPGA, as `parallax estimate --json` says it: {"resources": {"lut": {"value": ...}, ...}, ...}.

    device: a name such as "zynq-7020", or a file; all that there are if not given. size: (width, height) of the images that it
    is built for, px; the largest it takes if not given."""
    base = Machine() if machine is None else machine
    words = machine_words(base.preset, base.settings, base.disparities) + option_words({"device": device, "size": size})
    return json.loads(_said("estimate", *words, "--json"))


def toml_text(tree: Mapping) -> str:
    """A dictionary as TOML: tables of tables, lists, texts, numbers and bools."""
    lines = [f"{_text(key)} = {_value(key, value)}" for key, value in tree.items() if not isinstance(value, Mapping)]
    for key, table in tree.items():
        if isinstance(table, Mapping):
            lines.append(f"[{_text(key)}]")
            lines += [f"{_key(name)} = {_value(name, value)}" for name, value in table.items()]
    return "\n".join(lines) + "\n"


def _said(*words) -> str:
    code, out, err = _core.command(encoded(list(words)))
    lines = os.fsdecode(err)
    if code > 1:
        _, _, message = lines.partition("parallax: error: ")
        raise (UserError if code == 2 else Error)(message.rstrip("\n") or lines.rstrip("\n"))
    return os.fsdecode(out)


def _text(text) -> str:
    return json.dumps(str(text), ensure_ascii=False)


# Names of keys have a dot, those of numbers a slash: a key is a section and a name.
def _key(name) -> str:
    return ".".join(_text(part) for part in str(name).split(".")) if "/" not in str(name) else _text(name)


def _value(key, value) -> str:
    if hasattr(value, "tolist"):  # of NumPy
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float) and value.is_integer() and abs(value) < 2**53:
        return str(int(value))  # 150e6 is a whole number
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, (str, os.PathLike)):
        return _text(os.fspath(value))
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_text(name)} = {_value(name, one)}" for name, one in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(key, one) for one in value) + "]"
    raise UserError(f"{key}: a {type(value).__name__} is no value of a specification; expected a number, a text, a bool, a list "
                    "or a dictionary")
