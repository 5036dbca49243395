# SPDX-License-Identifier: Apache-2.0
"""Circuits and parameters whose cells calibrate the estimates, and others that are held out to judge them.

A case is (circuit, parameters, use). The parameters of the held-out ones occur in no fit: they lie between and beyond
those that do.
"""
CALIBRATE, HELD_OUT = "calibrate", "held_out"
NOT_CALIBRATED = "not_calibrated"  # registers and memories are asked to meet it, LUTs are not


def _case(circuit, use, **parameters):
    if circuit.startswith("fifo_"):
        return circuit, parameters, use
    return circuit, {"HEIGHT": 480, **parameters}, use


CASES = [
    # the small stages first: they take seconds each
    _case("census", CALIBRATE, WIDTH=512, WINDOW_WIDTH=3, WINDOW_HEIGHT=3),
    _case("census", CALIBRATE, WIDTH=512, WINDOW_WIDTH=5, WINDOW_HEIGHT=5),
    _case("census", CALIBRATE, WIDTH=1024, WINDOW_WIDTH=5, WINDOW_HEIGHT=5),
    _case("census", CALIBRATE, WIDTH=1024, WINDOW_WIDTH=9, WINDOW_HEIGHT=7),
    _case("census", HELD_OUT, WIDTH=1024, WINDOW_WIDTH=7, WINDOW_HEIGHT=5),
    _case("census", HELD_OUT, WIDTH=640, WINDOW_WIDTH=7, WINDOW_HEIGHT=7),
    _case("rectification", CALIBRATE, WIDTH=512, WINDOW=9, OFFSET_BITS=9),
    _case("rectification", CALIBRATE, WIDTH=512, WINDOW=79, OFFSET_BITS=12),
    _case("rectification", CALIBRATE, WIDTH=1024, WINDOW=41, OFFSET_BITS=11),
    _case("rectification", CALIBRATE, WIDTH=1024, WINDOW=79, OFFSET_BITS=12, FRACTION_BITS=3),
    _case("rectification", HELD_OUT, WIDTH=1024, WINDOW=79, OFFSET_BITS=12),
    _case("rectification", HELD_OUT, WIDTH=640, WINDOW=31, OFFSET_BITS=11),
    _case("subpixel", CALIBRATE, WIDTH=512, P=8, ITERATIONS=8),
    _case("subpixel", CALIBRATE, WIDTH=512, P=16, ITERATIONS=8, COST_BITS=9),
    _case("subpixel", CALIBRATE, WIDTH=1024, P=16, ITERATIONS=4),
    _case("subpixel", CALIBRATE, WIDTH=1024, P=32, ITERATIONS=8),
    _case("subpixel", HELD_OUT, WIDTH=1024, P=64, ITERATIONS=2),
    _case("subpixel", HELD_OUT, WIDTH=640, P=32, ITERATIONS=4, COST_BITS=10),
    _case("uniqueness", CALIBRATE, WIDTH=512, P=8, ITERATIONS=8),
    _case("uniqueness", CALIBRATE, WIDTH=512, P=16, ITERATIONS=8, COST_BITS=9),
    _case("uniqueness", CALIBRATE, WIDTH=1024, P=16, ITERATIONS=4),
    _case("uniqueness", CALIBRATE, WIDTH=1024, P=32, ITERATIONS=8),
    _case("uniqueness", HELD_OUT, WIDTH=1024, P=64, ITERATIONS=2),
    _case("uniqueness", HELD_OUT, WIDTH=640, P=32, ITERATIONS=4, COST_BITS=10),
    _case("noise_reduction", CALIBRATE, WIDTH=512, WINDOW=3),
    _case("noise_reduction", CALIBRATE, WIDTH=1024, WINDOW=5),
    _case("noise_reduction", CALIBRATE, WIDTH=512, WINDOW=7),
    _case("noise_reduction", HELD_OUT, WIDTH=1024, WINDOW=3),
    _case("noise_reduction", HELD_OUT, WIDTH=640, WINDOW=5),
    _case("noise_reduction", HELD_OUT, WIDTH=1024, WINDOW=7),
    _case("median_3x3", CALIBRATE, WIDTH=512),
    _case("median_3x3", HELD_OUT, WIDTH=1024),
    # the FIFOs of tests/rtl that yosys reads
    *(
        _case(f"fifo_{kind}", CALIBRATE, DEPTH=depth, WIDTH=width)
        for kind in ("registered", "first_word_fall_through", "block_ram")
        for depth, width in ((16, 8), (16, 24), (32, 72), (128, 12), (1500, 12))
    ),
    *(
        _case(f"fifo_{kind}", HELD_OUT, DEPTH=depth, WIDTH=width)
        for kind in ("registered", "first_word_fall_through", "block_ram")
        for depth, width in ((16, 352), (64, 8), (512, 24))
    ),
    _case("matching", CALIBRATE, WIDTH=512, P=4, ITERATIONS=8),
    _case("matching", CALIBRATE, WIDTH=512, P=8, ITERATIONS=4),
    _case("matching", CALIBRATE, WIDTH=1024, P=8, ITERATIONS=8),
    _case("matching", CALIBRATE, WIDTH=512, P=16, ITERATIONS=4),
    _case("matching", HELD_OUT, WIDTH=640, P=16, ITERATIONS=2),
    _case("matching", CALIBRATE, WIDTH=512, P=8, ITERATIONS=4, CODE_BITS=48),
    _case("matching", HELD_OUT, WIDTH=1024, P=32, ITERATIONS=4),
    _case("matching", CALIBRATE, WIDTH=1024, P=16, ITERATIONS=8),
    _case("matching", HELD_OUT, WIDTH=1024, P=8, ITERATIONS=16, CODE_BITS=34),
    _case("matching", HELD_OUT, WIDTH=1024, P=64, ITERATIONS=2),
]

# With the costs of the 7 series.
_ULTRASCALE_PLUS = [
    _case("census", HELD_OUT, WIDTH=1024, WINDOW_WIDTH=5, WINDOW_HEIGHT=5),
    _case("rectification", HELD_OUT, WIDTH=1024, WINDOW=79, OFFSET_BITS=12),
    _case("subpixel", HELD_OUT, WIDTH=1024, P=32, ITERATIONS=8),
    _case("uniqueness", HELD_OUT, WIDTH=1024, P=32, ITERATIONS=8),
    _case("noise_reduction", HELD_OUT, WIDTH=1024, WINDOW=5),
    _case("median_3x3", HELD_OUT, WIDTH=1024),
    _case("fifo_registered", HELD_OUT, DEPTH=16, WIDTH=352),
    _case("fifo_block_ram", HELD_OUT, DEPTH=512, WIDTH=24),
    _case("matching", NOT_CALIBRATED, WIDTH=1024, P=8, ITERATIONS=8),
    _case("matching", NOT_CALIBRATED, WIDTH=512, P=16, ITERATIONS=4),
]


def of_family(family):
    """UltraScale+ has no costs of its own to be fitted."""
    return _ULTRASCALE_PLUS if family == "ultrascale-plus" else CASES
