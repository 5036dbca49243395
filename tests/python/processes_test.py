# SPDX-License-Identifier: Apache-2.0
"""Threads, pools of processes and Ctrl-C."""

import concurrent.futures
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time
import unittest

import parallax
from support import SMALL, lasting

# Takes minutes.
ENDLESS = {"size": (640, 480), "timing_frames": 1000000}


def bytes_of(seed):
    return parallax.Machine(disparities=32).run(size=SMALL, seed=seed, verdict=False).raw.tobytes()


def children():
    with open(f"/proc/self/task/{os.getpid()}/children") as file:
        return file.read().split()


class Processes(unittest.TestCase):
    def test_threads_and_pools_give_the_same_bytes(self):
        alone = [bytes_of(seed) for seed in (1, 2)]
        self.assertNotEqual(*alone)
        with concurrent.futures.ThreadPoolExecutor(2) as threads:
            self.assertEqual(list(threads.map(bytes_of, (1, 2))), alone)
        for method in ("fork", "spawn"):
            with multiprocessing.get_context(method).Pool(2) as pool:
                self.assertEqual(pool.map(bytes_of, (1, 2)), alone)

    def test_none_is_left(self):
        before = children()
        bytes_of(1)
        parallax.evaluate([{}] * 3, size=SMALL)
        self.assertEqual(children(), before)

    def test_other_threads_go_on(self):
        counted = []
        stop = threading.Event()

        def count():
            while not stop.wait(0.001):
                counted.append(time.monotonic())

        thread = threading.Thread(target=count)
        thread.start()
        try:
            begin = time.monotonic()
            parallax.Machine().time(size=(320, 240))
            end = time.monotonic()
        finally:
            stop.set()
            thread.join()
        self.assertGreater(sum(begin < at < end for at in counted), 3)


class Interrupts(unittest.TestCase):
    def interrupted(self, call):
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        before = children()
        timer.start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            call()
        self.assertLess(time.monotonic() - begin, 5)
        timer.join()
        self.assertEqual(children(), before)

    def test_end_a_run(self):
        self.interrupted(lambda: parallax.Machine().time(**ENDLESS))

    def test_end_an_evaluation(self):
        self.interrupted(lambda: parallax.evaluate([{}] * 4, **ENDLESS))

    def test_of_the_terminal_reach_all_processes(self):
        script = ("import parallax\n"
                  "try:\n"
                  "    print('begins', flush=True)\n"
                  f"    parallax.Machine().time(**{ENDLESS})\n"
                  "except KeyboardInterrupt:\n"
                  "    print('interrupted')\n")
        child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True, start_new_session=True)
        self.assertEqual(child.stdout.readline(), "begins\n")
        time.sleep(0.3)
        os.killpg(child.pid, signal.SIGINT)
        self.assertEqual(child.communicate(timeout=10)[0], "interrupted\n")

    def test_a_killed_simulation_is_an_error(self):
        def kill():
            for child in children():
                os.kill(int(child), signal.SIGKILL)

        timer = threading.Timer(0.3, kill)
        timer.start()
        with self.assertRaisesRegex(parallax.Error, r"^the simulation was ended by signal 9 \(Killed\)$"):
            parallax.Machine().time(**ENDLESS)
        timer.join()

    def test_the_simulation_alone_that_is_interrupted_is_an_error(self):
        def interrupt():
            for child in children():
                os.kill(int(child), signal.SIGINT)

        timer = threading.Timer(0.5, interrupt)
        timer.start()
        with self.assertRaisesRegex(parallax.Error, "^parallax: interrupted after 0 frames$"):
            parallax.Machine().time(**ENDLESS)
        timer.join()


class Memory(unittest.TestCase):
    def test_that_there_is_not_is_an_error(self):
        script = ("import parallax, resource\n"
                  "resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))\n"
                  "try:\n"
                  "    parallax.Machine(disparities=32).run(size=(96, 64), verdict=False)\n"
                  "except parallax.Error as error:\n"
                  "    print(type(error).__name__, error)\n")
        said = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
        self.assertEqual(said.stdout, "Error no memory for the results: File too large\n", said.stderr)

    def test_is_given_back(self):
        def maps():
            with open("/proc/self/maps") as file:
                return sum("memfd:parallax" in line for line in file)

        machine = parallax.Machine(disparities=32)
        runs = [machine.run(size=SMALL, verdict=False) for _ in range(2)]
        raw = runs[0].raw
        self.assertEqual(maps(), 2)
        del runs
        self.assertEqual(maps(), 1)
        del raw
        self.assertEqual(maps(), 0)


class Import(unittest.TestCase):
    def test_does_not_load_numpy(self):
        script = "import parallax, sys; print('numpy' in sys.modules)"
        self.assertEqual(subprocess.run([sys.executable, "-c", script], capture_output=True, text=True).stdout, "False\n")


if __name__ == "__main__":
    unittest.main()
