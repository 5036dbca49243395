# SPDX-License-Identifier: Apache-2.0
"""Image pairs of 32x16 px that ask of a circuit what the built-in scene does not: flat.pgm, in which all costs are equal, and
noise_left.pgm with noise_right.pgm, which have nothing in common, so that the best of the costs is hardly better than the others."""
import os
import random

WIDTH, HEIGHT = 32, 16


def write_pgm(name, values):
    with open(name, "wb") as file:
        file.write(b"P5\n%d %d\n255\n" % (WIDTH, HEIGHT) + bytes(values))


def write_images(folder):
    write_pgm(os.path.join(folder, "flat.pgm"), [100] * (WIDTH * HEIGHT))
    values = random.Random(1)
    for side in ("left", "right"):
        write_pgm(os.path.join(folder, f"noise_{side}.pgm"), [values.randrange(256) for _ in range(WIDTH * HEIGHT)])
