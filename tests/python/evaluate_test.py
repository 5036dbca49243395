# SPDX-License-Identifier: Apache-2.0
import unittest

import parallax
from support import SMALL, lasting

CLOCKS = (50e6, 100e6, 150e6)


class Evaluate(unittest.TestCase):
    def test_gives_each_what_it_has_alone_in_order(self):
        machine = parallax.Machine(disparities=32)
        for workers in (1, 3, None):
            runs = parallax.evaluate([{"clocks.core_hz": hz} for hz in CLOCKS], machine=machine, size=SMALL, workers=workers)
            for hz, run in zip(CLOCKS, runs):
                alone = machine.changed({"clocks.core_hz": hz}).time(size=SMALL)
                self.assertEqual(lasting(run.timing), lasting(alone.timing))
                self.assertEqual(run["run/command"], alone["run/command"])

    def test_takes_machines(self):
        machines = [parallax.Machine("core-alone", disparities=32), parallax.Machine(disparities=64)]
        runs = parallax.evaluate(machines, size=SMALL, rectified=True)
        self.assertEqual([run["input/disparity_range"] for run in runs], [32, 64])

    def test_says_what_is_wrong_with_a_point(self):
        points = [{}, {"matching.pq": 1}, {"streams.left_texture.depth": 20}, {"matching.p1": 9}]
        runs = parallax.evaluate(points, size=SMALL)
        self.assertEqual([run.status for run in runs], ["done", "invalid", "stuck", "done"])
        self.assertEqual(runs[1].message, "--set matching.pq=1: unknown key matching.pq; the nearest is matching.p1")
        with self.assertRaises(parallax.Deadlock) as caught:
            parallax.Machine(settings=points[2]).time(size=SMALL)
        self.assertEqual(runs[2].message, str(caught.exception))
        with self.assertRaisesRegex(KeyError, "^the run has no metric performance/frame_rate, as it is invalid: --set matching"):
            runs[1]["performance/frame_rate"]
        self.assertEqual(runs[1].metrics(), {})

    def test_of_nothing_is_nothing(self):
        self.assertEqual(parallax.evaluate([]), [])
        with self.assertRaisesRegex(parallax.UserError, "^workers is 0, allowed is 1 or more$"):
            parallax.evaluate([{}], workers=0)
        with self.assertRaisesRegex(parallax.UserError, r"^evaluate\(\) looks for no verdict: Machine.time\(verdict=True\) does, "
                                                        "for one machine$"):
            parallax.evaluate([{}], verdict=True)
        with self.assertRaisesRegex(parallax.UserError, r"^left is an array: evaluate\(\) takes files; or their size, as images"):
            parallax.evaluate([{}], left=[[1]], right=[[1]])

    def test_options_that_are_wrong_are_each_points(self):
        run, = parallax.evaluate([{}], size="x")
        self.assertEqual((run.status, run.message), ("invalid", "--size: 'x' is not a size such as 640x480"))

    def test_notes_are_told(self):
        run, = parallax.evaluate([{}], size=(100, 64))
        self.assertEqual(run.notes, parallax.Machine().time(size=(100, 64)).notes)


if __name__ == "__main__":
    unittest.main()
