#!/usr/bin/env python3
"""python_elevations.py MARSVIEW-CLI DEM: the time of 100 000 elevations in Python, against the same in
C++: `sample --stdin` with them minus `sample --stdin` with one, which also reads and prints numbers.

    PYTHONPATH=build/release/python python3 tests/bench/python_elevations.py \\
        build/release/bin/marsview-cli resources/samples/mars_mola_4ppd.tif
"""

import subprocess
import sys
import time

import numpy

import marsview

COUNT = 100_000
cli, dem = sys.argv[1:]
random = numpy.random.default_rng(1)
lons = random.uniform(0, 360, COUNT)
lats = random.uniform(-80, 80, COUNT)
lines = "".join(f"{lon!r} {lat!r}\n" for lon, lat in zip(lons.tolist(), lats.tolist()))


def seconds(work):
    times = []
    for _ in range(5):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times)


def sample(text):
    subprocess.run(
        [cli, "sample", dem, "--stdin", "--lonlat"], input=text, text=True, check=True,
        stdout=subprocess.DEVNULL,
    )


terrain = marsview.open(dem)
in_python = seconds(lambda: terrain.elevation(lons, lats))
in_cpp = seconds(lambda: sample(lines)) - seconds(lambda: sample(lines.split("\n", 1)[0]))
print(f"Python {1e3 * in_python:.1f} ms, C++ {1e3 * in_cpp:.1f} ms, ratio {in_python / in_cpp:.2f}")
