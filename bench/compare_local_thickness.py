#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Local thickness by largest balls, beside PoreSpy and localthickness, all in one process; writes JSON.

Each round measures every volume in every way; numbers are medians of CPU seconds. PoreSpy and localthickness give radii,
which are compared with half of our diameters: mean and largest difference over the object. Balls are not cut.

Usage: PYTHON bench/compare_local_thickness.py [--data FOLDER] [--rounds N] [--output FILE]
PYTHON: the interpreter of an environment with medialvoxel, porespy and localthickness. --data: of the real volumes
"""

import argparse
import importlib.metadata
import json
import os
import pathlib
import statistics
import time
import zlib

import localthickness
import medialvoxel
import numpy as np
import porespy
from compare_arrays import gyroid
from scipy import ndimage

from run_benchmarks import describe_revision, text_of

PEERS = {
    "porespy": lambda mask: porespy.filters.local_thickness(mask),
    "localthickness": lambda mask: localthickness.local_thickness(mask, scale=1),
}


def solid(size=256):
    """A block with bores."""
    z, y, x = np.ogrid[:size, :size, :size]
    bores = [(x - 90) ** 2 + (y - 100) ** 2 < 30**2, (x - 170) ** 2 + (z - 128) ** 2 < 20**2, (y - 190) ** 2 + (z - 70) ** 2 < 12**2]
    return (abs(x - 128) < 110) & (abs(y - 128) < 110) & (abs(z - 128) < 110) & ~np.logical_or.reduce(np.broadcast_arrays(*bores))


def engine(folder):
    content = (folder / "engine.mha").read_bytes()
    values = zlib.decompress(content[content.index(b"= LOCAL\n") + 8 :])
    return np.frombuffer(values, np.uint8).reshape(110, 256, 256) >= 72


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=pathlib.Path, help="folder of the real volumes; default: leave them out")
    parser.add_argument("--rounds", type=int, default=3, help="default 3")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path(__file__).parent / "results/local-thickness.json")
    return parser.parse_args()


def measure(mask, rounds):
    largest = 2 * float(ndimage.distance_transform_edt(mask).max()) + 1
    ours = {f"medialvoxel, threads {n}": lambda mask, n=n: medialvoxel.local_thickness(mask, method="sphere", largest_ball=largest, threads=n) for n in (1, 2)}
    ways, seconds, found = ours | PEERS, {}, {}
    for number in range(rounds):
        names = list(ways)[number % len(ways) :] + list(ways)[: number % len(ways)]
        for name in names:
            start, clock = time.perf_counter(), time.process_time()
            result = ways[name](mask)
            found[name] = result.thickness if isinstance(result, medialvoxel.LocalThickness) else result
            seconds.setdefault(name, []).append((time.process_time() - clock, time.perf_counter() - start))
    radii = found["medialvoxel, threads 1"][mask] / 2
    rows = {}
    for name, runs in seconds.items():
        cpu = statistics.median(value for value, _ in runs)
        rows[name] = {
            "cpu_seconds": round(cpu, 3),
            "wall_seconds": round(statistics.median(value for _, value in runs), 3),
            "million_voxels_per_cpu_second": round(mask.size / cpu / 1e6, 2),
        }
        if name in PEERS:
            difference = found[name][mask] - radii
            rows[name] |= {"mean_difference": round(float(difference.mean()), 3), "largest_difference": round(float(abs(difference).max()), 3)}
    return {"voxels": mask.size, "object_voxels": int(mask.sum()), "largest_diameter": round(2 * float(radii.max()), 2), "ways": rows}


def main():
    arguments = parse_arguments()
    masks = {"gyroid": gyroid(256), "solid": solid()} | ({"engine": engine(arguments.data)} if arguments.data else {})
    result = {
        "revision": describe_revision(),
        "processor": text_of("/proc/cpuinfo", r"^model name\s*:\s*(.*)$"),
        "load_at_start": os.getloadavg()[0],
        "versions": {name: importlib.metadata.version(name) for name in ("medialvoxel", *PEERS, "numpy", "scipy")},
        "rounds": arguments.rounds,
        "volumes": {name: measure(mask, arguments.rounds) for name, mask in masks.items()},
    }
    arguments.output.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")
    for name, volume in result["volumes"].items():
        for way, row in volume["ways"].items():
            print(f"{name:8} {way:24} {row}")


if __name__ == "__main__":
    main()
