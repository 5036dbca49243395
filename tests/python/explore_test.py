# SPDX-License-Identifier: Apache-2.0
import json
import os
import subprocess
import sys
import tempfile
import time
import unittest

import numpy
import parallax
from support import error_line, program

SPEC = {
    "description": 'what "holds" it',
    "run": {"preset": "core-alone", "rectified": True, "size": "64x48", "timing-frames": 2},
    "set": {"census.enabled": True},
    "vary": {"clocks.core_hz": {"from": 100e6, "to": 160e6, "step": 20e6}, "streams.default_depth": numpy.array([4, 8])},
    "link": {"matching.iterations": "32 / 16"},
    "constraints": {"performance/frame_rate": {"at_least": 3000}},
    "objectives": {"performance/frame_rate": "most", "energy/frame_total": "least"},
}


class Explore(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name, text=None):
        path = os.path.join(self.folder, name)
        if text is not None:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        return path

    def test_is_what_the_program_finds(self):
        spec = self.path("s.toml", parallax.exploration.toml_text(SPEC))
        code, out, err = program("explore", spec, "--out", self.path("there"), "--json")
        self.assertEqual((code, err), (0, ""))
        for given in (spec, SPEC):
            found = parallax.explore(given, out=self.path("here"))
            self.assertEqual({**found.summary, "evaluated": 8}, json.loads(out))
            with open(self.path("here/points.csv")) as here, open(self.path("there/points.csv")) as there:
                self.assertEqual(here.read(), there.read())
        self.assertEqual(found.summary["evaluated"], 0, "known from the file's run")
        self.assertEqual(len(found), 8)
        self.assertEqual(found["clocks.core_hz"].tolist(), [hz for hz in (100e6, 120e6, 140e6, 160e6) for _ in "ab"])
        self.assertEqual(found.units["performance/frame_rate"], "frames/s")
        self.assertEqual(found["satisfied"].dtype, bool)
        self.assertEqual(found["status"].tolist(), ["done"] * 8)
        best = [point["point"] for point in found.summary["front"]]
        self.assertEqual([point["point"] for point in found.front], best)
        self.assertEqual(numpy.flatnonzero(found["front"]).tolist(), best)

    def test_keeps_nothing_without_a_folder(self):
        before = set(os.listdir(tempfile.gettempdir()))
        found = parallax.explore({**SPEC, "constraints": {"performance/frame_rate": {"at_least": 1e9}}})
        self.assertEqual(found.front, [])
        self.assertIn("nearest", found.summary)
        self.assertFalse({name for name in set(os.listdir(tempfile.gettempdir())) - before if name.startswith("tmp")
                          and os.path.exists(os.path.join(tempfile.gettempdir(), name, "exploration.toml"))})

    def test_shows_points_that_have_no_numbers(self):
        found = parallax.explore({"run": SPEC["run"], "vary": {"streams.default_depth": [8, 1 << 23]}})
        self.assertEqual(found["status"].tolist(), ["done", "invalid"])
        self.assertTrue(numpy.isnan(found["performance/frame_rate"][1]))

    def test_says_what_the_program_says(self):
        wrong = self.path("s.toml", "[vary]\nclocks.core = 3\n")
        with self.assertRaises(parallax.UserError) as caught:
            parallax.explore(wrong, out=self.path("out"))
        self.assertEqual(str(caught.exception), error_line("explore", wrong, "--out", self.path("out")))
        with self.assertRaisesRegex(parallax.UserError, r"^the exploration has no column frame_rate: point, "):
            parallax.explore(SPEC)["frame_rate"]
        with self.assertRaisesRegex(parallax.UserError, "^clocks.core_hz: a object is no value of a specification"):
            parallax.explore({"vary": {"clocks.core_hz": object()}})

    def test_keeps_what_was_evaluated_when_it_is_interrupted(self):
        spec = {**SPEC, "run": {**SPEC["run"], "timing-frames": 3000}}
        script = f"import parallax\nparallax.explore({dict(spec, vary={'streams.default_depth': [4, 8, 16]})!r}, out='out')"
        child = subprocess.Popen([sys.executable, "-c", script], cwd=self.folder, stderr=subprocess.PIPE, text=True)
        for _ in range(500):
            if os.path.exists(self.path("out/results.db")):
                break
            time.sleep(0.01)
        child.send_signal(2)
        _, said = child.communicate(timeout=20)
        self.assertIn("KeyboardInterrupt", said)
        self.assertTrue(os.path.exists(self.path("out/results.db")))


class Estimate(unittest.TestCase):
    def test_is_what_the_program_says(self):
        _, out, _ = program("estimate", "--json", "--device", "zynq-7020", "--set", "matching.parallelism=16", "--size", "640x480")
        machine = parallax.Machine(settings={"matching.parallelism": 16})
        self.assertEqual(parallax.estimate(machine, device="zynq-7020", size=(640, 480)), json.loads(out))
        self.assertIn("zynq_7045", parallax.estimate()["devices"])
        with self.assertRaises(parallax.UserError) as caught:
            parallax.estimate(device="zynq")
        self.assertIn("no device 'zynq'", str(caught.exception))


class EvaluateTakes(unittest.TestCase):
    def test_a_list_of_points(self):
        with self.assertRaisesRegex(parallax.UserError, r"^evaluate\(\) takes a list of points; this is one, a dictionary"):
            parallax.evaluate({})
        with self.assertRaisesRegex(parallax.UserError, r"a dictionary of keys or a Machine; a point is 3$"):
            parallax.evaluate([3])


if __name__ == "__main__":
    unittest.main()
