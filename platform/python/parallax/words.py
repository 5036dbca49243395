# SPDX-License-Identifier: Apache-2.0
"""Settings and options as words of the command line, which is what the libraries read."""

import os

from .errors import UserError

# Options that switch off what is on.
_SWITCHES = ("verdict", "point_cloud")
# Options whose values are one word, separated by commas; others that have several are repeated.
_LISTS = ("trace", "trace_parts", "cameras")


def value_text(key, value):
    """A value as `--set` takes it: 150e6 is a whole number, a tuple of texts a list with commas."""
    if isinstance(value, (list, tuple, set, frozenset)):
        return ",".join(value_text(key, one) for one in value)
    if hasattr(value, "item"):  # a number of NumPy's
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return str(int(value)) if value.is_integer() and abs(value) < 2**53 else repr(value)
    if isinstance(value, (int, str)):
        return str(value)
    raise UserError(f"{key}: a {type(value).__name__} is no value of a key; expected a number, a text or a bool")


def assignments(settings):
    """A dictionary of keys as "key=value" each."""
    return [f"{key}={value_text(key, value)}" for key, value in dict(settings).items()]


def option_words(options):
    """The options of `parallax run` by their names, with _ for -: None is one that is not given."""
    words = []
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if name in _SWITCHES:
            words += [] if value in (None, True) else ["--no-" + option[2:]]
        elif value is True:
            words.append(option)
        elif value is not None and value is not False:
            for one in _texts(name, value):
                words += [f"{option}={one}"] if one.startswith("-") else [option, one]
    return words


def input_words(options, *, size, seed, frames, verdict):
    """Those of a run, in one order whoever asks."""
    return option_words({**options, "size": size, "seed": seed, "frames": frames, "verdict": verdict})


def machine_words(preset, settings, disparities):
    """The options that make a machine: `--preset`, `--set`, `--disparities`."""
    words = [] if preset == "scenescan-pro" else option_words({"preset": preset})
    for one in assignments(settings):
        words += ["--set", one]
    return words + option_words({"disparities": disparities})


def encoded(words):
    """As the libraries take them: names of files may be any bytes."""
    return [os.fsencode(word) for word in words]


def _texts(name, value):
    if name == "size" and isinstance(value, (list, tuple)):
        return ["x".join(str(number) for number in value)]
    if isinstance(value, (list, tuple)):
        texts = [_text(one) for one in value]
        return [",".join(texts)] if name in _LISTS else texts
    return [_text(value)]


def _text(value):
    return os.fsdecode(value) if isinstance(value, (str, bytes, os.PathLike)) else str(value)
