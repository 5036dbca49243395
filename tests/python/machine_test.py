# SPDX-License-Identifier: Apache-2.0
import copy
import json
import pickle
import unittest

import numpy
import parallax
from support import error_line, program


def flat(tree, prefix=""):
    for name, below in tree.items():
        if isinstance(below, dict):
            yield from [(prefix + name, below)] if "value" in below else flat(below, f"{prefix}{name}.")


def line_of(exception):
    """An exception's text; the program has its presets elsewhere."""
    return str(exception).replace("/python/parallax/presets/", "/presets/")


class Keys(unittest.TestCase):
    def test_are_those_of_the_program(self):
        machine = parallax.Machine("scenescan-pro", {"clocks.core_hz": 150e6}, disparities=64)
        tree = json.loads(program("config", "--json", "--docs", "--set", "clocks.core_hz=150e6", "-d", "64")[1])
        shown_keys = dict(flat(tree))
        self.assertEqual(set(machine), set(shown_keys))
        for name, shown in shown_keys.items():
            key = machine.key(name)
            self.assertEqual((key.value, key.unit, key.documentation, key.tag, key.source),
                             (shown["value"], shown["unit"], shown["documentation"], shown["tag"], shown["source"]), name)
            self.assertEqual(machine[name], shown["value"])

    def test_take_pythons_and_numpys_values(self):
        machine = parallax.Machine()
        for key, given, value in (
            ("clocks.core_hz", 150e6, 150000000), ("clocks.core_hz", numpy.int64(5000000), 5000000),
            ("clocks.core_hz", "125e6", 125000000), ("uniqueness.enabled", False, False),
            ("uniqueness.enabled", numpy.bool_(True), True), ("matching.paths", ("w", "n"), "w, n"),
        ):
            machine[key] = given
            self.assertEqual(machine[key], value)
        self.assertEqual(list(machine.settings)[:2], ["clocks.core_hz", "uniqueness.enabled"])

    def test_that_are_wrong_are_refused_as_by_the_program(self):
        machine = parallax.Machine(settings={"matching.p1": 9})
        for key, value in (("matching.pq", 50), ("matching.p1", -5), ("matching.p1", 200), ("matching", 1),
                           ("matching.p1", "many"), ("matching.p1", "")):
            with self.assertRaises(parallax.UserError) as caught:
                machine.set(key, value)
            self.assertEqual(line_of(caught.exception), error_line("config", "--set", f"{key}={value}"))
        with self.assertRaisesRegex(parallax.UserError, "^matching.p1: a NoneType is no value of a key; expected a number, a "
                                                        "text or a bool$"):
            machine.set("matching.p1", None)
        self.assertEqual(machine["matching.p1"], 9)
        self.assertEqual(machine.settings, {"matching.p1": 9})
        with self.assertRaises(parallax.UserError) as caught:
            parallax.Machine(disparities=33)
        self.assertEqual(str(caught.exception), error_line("config", "-d", "33"))
        with self.assertRaisesRegex(parallax.UserError, "^no preset 'scnescan' in .*; the nearest is scenescan-pro$"):
            parallax.Machine("scnescan")

    def test_that_go_together_are_set_together(self):
        machine = parallax.Machine()
        with self.assertRaises(parallax.UserError):
            machine.set("matching.p1", 200)
        machine.set({"matching.p1": 200, "matching.p2": 220})
        self.assertEqual((machine["matching.p1"], machine["matching.p2"]), (200, 220))

    def test_that_there_are_not(self):
        machine = parallax.Machine()
        with self.assertRaises(KeyError) as caught:
            machine["matching.directions"]
        self.assertIsInstance(caught.exception, parallax.UserError)
        self.assertEqual(str(caught.exception), "unknown key matching.directions; the nearest is matching.paths")
        self.assertNotIn("matching.directions", machine)


class Machines(unittest.TestCase):
    def test_are_copied_and_changed(self):
        machine = parallax.Machine("core-alone", {"clocks.core_hz": 1e8})
        for same in (copy.deepcopy(machine), pickle.loads(pickle.dumps(machine)), machine.changed({})):
            self.assertEqual(same.words(), ["--preset", "core-alone", "--set", "clocks.core_hz=100000000"])
            same["clocks.core_hz"] = 2e8
        self.assertEqual(machine["clocks.core_hz"], 10**8)
        self.assertEqual(machine.changed({"matching.p1": 3}).settings, {"clocks.core_hz": 1e8, "matching.p1": 3})

    def test_say_what_they_are(self):
        machine = parallax.Machine(settings={"matching.p1": 3}, disparities=64)
        self.assertEqual(repr(machine), "parallax.Machine('scenescan-pro', {'matching.p1': 3}, disparities=64)")
        self.assertIn("core-alone", parallax.presets())


class Module(unittest.TestCase):
    def test_has_the_programs_version(self):
        self.assertEqual(program("--version")[1], f"parallax {parallax.__version__} ({parallax.__revision__})\n")

    def test_has_docstrings(self):
        for name in parallax.__all__:
            self.assertTrue(getattr(parallax, name).__doc__, name)


if __name__ == "__main__":
    unittest.main()
