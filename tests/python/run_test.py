# SPDX-License-Identifier: Apache-2.0
import json
import os
import pickle
import tempfile
import unittest

import numpy
import parallax
from PIL import Image
from support import SMALL, error_line, lasting, packed, program, repeated

STUCK = {"streams.left_texture.depth": 20}


def scene_pair():
    """A rectified pair of the program's, as arrays, and its files."""
    folder = tempfile.TemporaryDirectory()
    code, _, said = program("scene", "--rectified", "--size", "96x64", "--out", folder.name)
    assert code == 0, said
    paths = [os.path.join(folder.name, name + ".png") for name in ("left", "right")]
    return folder, paths, [numpy.array(Image.open(path)) for path in paths]


class SameAsTheProgram(unittest.TestCase):
    def compare(self, run, options=()):
        with tempfile.TemporaryDirectory() as folder:
            code, _, said = program(*repeated(run), *options, "--out", folder)
            self.assertEqual(code, 0, said)
            with open(os.path.join(folder, "timing.json")) as file:
                self.assertEqual(lasting(run.timing), lasting(json.load(file)))
            for frame in run.frames:
                name = f"frame_{frame.index:04}" if len(run.frames) > 1 else ""
                with open(os.path.join(folder, name, "disparity.bin"), "rb") as file:
                    self.assertEqual(packed(frame.raw), file.read())
                left = Image.open(os.path.join(folder, name, "left_rectified.png"))
                self.assertTrue((frame.left_rectified == numpy.array(left)).all())
                causes = Image.open(os.path.join(folder, name, "cause_labels.png"))
                self.assertTrue((frame.causes == numpy.array(causes)).all())

    def test_the_scene(self):
        machine = parallax.Machine("scenescan-pro", {"clocks.core_hz": 150e6, "matching.p2": 60}, disparities=64)
        run = machine.run(size=SMALL, seed=3)
        self.compare(run)
        self.assertEqual(run["quality/bad_1"], run.frame().score()["bad_1"])
        self.assertIn("limit/part", run.metrics())

    def test_many_runs_in_one_process(self):
        for seed in (1, 2, 1):
            self.compare(parallax.Machine(disparities=32).run(size=SMALL, seed=seed, verdict=False))

    def test_the_timing_alone(self):
        machine = parallax.Machine(disparities=64)
        run = machine.time(size=SMALL)
        self.compare(run)
        self.assertEqual(run.frames, ())
        self.assertEqual(run["performance/frame_rate"], machine.run(size=SMALL, verdict=False)["performance/frame_rate"])

    def test_rectified_images(self):
        machine = parallax.Machine(disparities=32)
        run = machine.run(size=SMALL, verdict=False)
        with tempfile.TemporaryDirectory() as folder:
            words = ["--size", "96x64", *machine.words(), "--stage", "rectification", "--out", folder]
            code, _, said = program("vectors", *words)
            self.assertEqual(code, 0, said)
            for side in ("left", "right"):
                with open(os.path.join(folder, f"{side}_rectified.memh")) as file:
                    pixels = [int(line, 16) for line in file if not line.startswith("//")]
                self.assertEqual(getattr(run, f"{side}_rectified").ravel().tolist(), pixels)
        self.assertFalse((run.left_rectified == run.right_rectified).all())

    def test_a_sequence_of_the_scene(self):
        run = parallax.Machine(disparities=32).run(size=SMALL, frames=2, verdict=False)
        self.assertEqual([frame.index for frame in run.frames], [0, 1])
        self.compare(run)

    def test_files(self):
        folder, paths, _ = scene_pair()
        with folder:
            self.compare(parallax.Machine(disparities=32).run(*paths, verdict=False))

    def test_folders(self):
        with tempfile.TemporaryDirectory() as folder:
            run = parallax.Machine(disparities=32).run(size=SMALL, verdict=False, keep=False, out=folder, trace=["csv", "json"])
            self.assertEqual(run.frames, ())
            with open(os.path.join(folder, "timing.json")) as file:
                self.assertEqual(run.timing, json.load(file))
            self.assertTrue(any(name.startswith("trace") and name.endswith(".csv") for name in os.listdir(folder)))


class Arrays(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.machine = parallax.Machine(disparities=32)
        cls.folder, cls.paths, cls.pair = scene_pair()
        cls.run_of_files = cls.machine.run(*cls.paths, verdict=False)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def same(self, left, right, images=1, **options):
        run = self.machine.run(left, right, verdict=False, **options)
        self.assertEqual(len(run.frames), images)
        for frame in run.frames:
            self.assertTrue((frame.raw == self.run_of_files.raw).all())
        return run

    def test_have_the_results_of_files(self):
        run = self.same(*self.pair)
        self.assertEqual(lasting(run.timing)["performance"], lasting(self.run_of_files.timing)["performance"])
        self.assertIn("--left left --right right", run["run/command"])

    def test_may_have_gaps_and_any_order_of_bytes(self):
        wide = [numpy.repeat(image, 2, axis=1)[:, ::2] for image in self.pair]
        self.assertFalse(wide[0].flags.c_contiguous)
        self.same(*wide)
        run = self.same(*[(image.astype(">u2") << 4) for image in self.pair], image_bits=12)
        self.assertEqual(run.notes, ())

    def test_may_have_colours(self):
        for channels in (3, 4):
            run = self.same(*[numpy.dstack([image] * channels) for image in self.pair])
            self.assertEqual(run.notes, ("colour images (left) are converted to mono: 0.299 R + 0.587 G + 0.114 B",))
        # Red counts 0.299, blue 0.114: pixels as a file of the same colours has them.
        red = numpy.zeros((*self.pair[0].shape, 3), numpy.uint8)
        red[..., 0] = self.pair[0]
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "red.png")
            Image.fromarray(red).save(path)
            of_file = self.machine.run(path, path, verdict=False)
        self.assertTrue((self.machine.run(red, red, verdict=False).left_rectified == of_file.left_rectified).all())

    def test_may_be_wider_than_a_tile(self):
        random = numpy.random.default_rng(1)
        pair = [[random.integers(0, 256, (16, 1216), dtype=numpy.uint8) for _ in range(2)] for _ in range(2)]
        run = self.machine.run(*pair, verdict=False)
        self.assertGreater(run.timing["configuration"]["tiles"]["largest_number"], 1)
        self.assertLess(run.timing["configuration"]["tiles"]["limit"], 1216)
        for frame, left, right in zip(run.frames, *pair):  # nothing is to be rectified
            self.assertTrue((frame.left_rectified == left).all())
            self.assertTrue((frame.right_rectified == right).all())

    def test_may_be_a_sequence(self):
        self.same(*[[image] * 3 for image in self.pair], images=2, frames=2)

    def test_that_are_wrong_are_refused(self):
        left, right = self.pair
        for arguments, line in (
            ((left.astype(float), right), "left is an array of float64, expected uint8 or uint16"),
            (([left, left[0]], [right, right]), r"left\[1\] has the shape \(96,\), expected \(rows, columns\), or \(rows, "
             r"columns, 3\) for RGB, 4 for RGBA"),
            ((left, right[:0]), r"right has the shape \(0, 96\), expected .*"),
            ((left, None), "right is missing, but the other image is an array"),
            ((self.paths[0], right), "left is a path, but the other image is an array"),
            (([left], [right] * 2), "left has 1 images, right 2: a sequence needs pairs"),
            (([], []), "left and right hold no image"),
            ((left, right[:32]), "the left image left is 96x64, the right image right is 96x32; both must have one size"),
            (([left] * 2, [right, right[:32]]), r".*the right image right\[1\] is 96x32; both must have one size"),
            ((numpy.zeros((16, 5000), numpy.uint8),) * 2, "image left is 5000x16, larger than the largest size .*"),
        ):
            with self.assertRaisesRegex(parallax.UserError, f"^{line}$"):
                self.machine.run(*arguments, verdict=False)
        with self.assertRaisesRegex(parallax.UserError, "^--size and --rectified are for the built-in scene, but images are"):
            self.machine.run(left, right, size=SMALL)
        with self.assertRaisesRegex(parallax.UserError, "^--input and --left/--right exclude each other$"):
            self.machine.run(left, right, input=self.folder.name)

    def test_are_timed_by_their_size(self):
        run = self.machine.time(*self.pair)
        self.assertEqual((run["input/width"], run["input/height"]), SMALL)


class Results(unittest.TestCase):
    def test_are_values_and_arrays(self):
        run = parallax.Machine(disparities=32).run(size=SMALL, verdict=False)
        self.assertEqual(run.status, "done")
        self.assertEqual(run["performance/frame_rate"], run.timing["performance"]["frame_rate"]["value"])
        self.assertEqual(run.metric("performance/frame_rate").unit, "frames/s")
        self.assertEqual(run.metrics()["performance/frame_rate"], run["performance/frame_rate"])
        self.assertEqual(run.timing["configuration"]["matching"]["parallelism"], 32)
        self.assertEqual((run.disparity.dtype, run.disparity.shape), (numpy.float32, SMALL[::-1]))
        self.assertTrue((numpy.isnan(run.disparity) == ~run.valid).all())
        self.assertTrue((run.disparity[run.valid] == run.raw[run.valid] / 16).all())
        self.assertTrue((run.valid == numpy.isin(run.causes, [parallax.CAUSES.index(name) for name in
                                                              ("matched", "interpolated")])).all())
        self.assertIsNotNone(run.raw.base)  # not a copy
        raw = run.raw
        again = pickle.loads(pickle.dumps(run))
        self.assertTrue((again.raw == raw).all())
        before = raw.copy()
        del run, again
        self.assertTrue((raw == before).all())  # it keeps its memory

    def test_that_there_are_not(self):
        run = parallax.Machine(disparities=32).time(size=SMALL)
        with self.assertRaisesRegex(KeyError, "^the run has no metric performance/rate$"):
            run["performance/rate"]
        with self.assertRaisesRegex(parallax.Error, "^the run has 0 frames with images; time\\(\\) and keep=False keep none$"):
            run.disparity

    def test_are_scored(self):
        frame = parallax.Machine(disparities=32).run(size=SMALL, verdict=False).frame()
        truth = frame.disparity + 2.5
        score = frame.score(truth)
        self.assertEqual((score["coverage"], score["bad_2"], score["bad_3"], score["mean_error"]), (100, 100, 0, 2.5))
        half = numpy.zeros(truth.shape, bool)
        half[:32] = True
        self.assertEqual(frame.score(truth, half)["scored_pixels"], frame.valid[:32].sum())
        self.assertEqual(frame.score(truth, half * numpy.uint8(255)), frame.score(truth, half))
        with self.assertRaisesRegex(parallax.UserError, r"^truth has the shape \(2, 2\), the disparities have \(64, 96\)$"):
            frame.score(numpy.ones((2, 2)))
        with self.assertRaisesRegex(parallax.UserError, r"^mask has the shape \(1,\), the disparities have \(64, 96\)$"):
            frame.score(truth, numpy.ones(1))
        frame.truth = None
        with self.assertRaisesRegex(parallax.UserError, "^this frame has no ground truth: give one$"):
            frame.score()


class Faults(unittest.TestCase):
    def test_are_the_programs_lines(self):
        machine = parallax.Machine()
        for options, words in (
            ({"sise": 3}, ["--sise", "3"]), ({"size": "x"}, ["--size", "x"]), ({"left": "a.png"}, ["--left", "a.png"]),
            ({"frames": 0}, ["--frames", "0"]), ({"seed": -1}, ["--seed=-1"]), ({"mask": "m.png"}, ["--mask", "m.png"]),
            ({"left": "no.png", "right": "no.png"}, ["--left", "no.png", "--right", "no.png"]),
            ({"report": True}, ["--report"]), ({"size": ""}, ["--size", ""]), ({"size": (64, 9000)}, ["--size", "64x9000"]),
        ):
            with self.subTest(options), self.assertRaises(parallax.UserError) as caught:
                machine.run(**options)
            self.assertEqual(str(caught.exception), error_line("run", *words))

    def test_of_what_is_the_programs_alone(self):
        for options, line in (
            ({"vary": "matching.p1=1,2"}, r"vary is the command line's: here evaluate\(\) times many points"),
            ({"relax": True}, "relax is the command line's: parallax run --timing-only --relax"),
            ({"circuit": "census=census.sv"}, "circuits are the command line's: parallax run --circuit"),
            ({"help": True}, "help is the command line's: parallax run --help"),
        ):
            with self.assertRaisesRegex(parallax.UserError, f"^{line}$"):
                parallax.Machine().run(**options)

    def test_deadlocks_say_what_the_program_says(self):
        machine = parallax.Machine(settings=STUCK)
        with self.assertRaises(parallax.Deadlock) as caught:
            machine.run(size=SMALL)
        code, _, said = program("run", "--size", "96x64", *machine.words())
        self.assertEqual(code, 1)
        self.assertTrue(said.endswith("parallax: error: " + str(caught.exception) + "\n"), said)
        self.assertEqual(caught.exception.run["run/status"], "stuck")
        again = pickle.loads(pickle.dumps(caught.exception))
        self.assertEqual(str(again), str(caught.exception))

    def test_notes_are_told(self):
        run = parallax.Machine(disparities=32).time(size=(100, 64))
        _, _, said = program(*repeated(run))
        self.assertEqual("".join(f"parallax: note: {note}\n" for note in run.notes), said)


if __name__ == "__main__":
    unittest.main()
