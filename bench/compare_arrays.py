#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Time of calls on one array in memory, beside those of scipy and scikit-image, all in one process; writes JSON.

The volume is a gyroid with walls of about 5 voxels, of type bool. Each round makes every call once; numbers are medians.
Those of scipy and scikit-image take one thread.

Usage: PYTHON bench/compare_arrays.py [--size N] [--rounds N] [--output FILE]
PYTHON: the interpreter of an environment with medialvoxel, scipy and scikit-image.
"""

import argparse
import json
import os
import pathlib
import platform
import statistics
import time

import medialvoxel
import numpy as np
import scipy
import skimage
from scipy import ndimage
from skimage import measure, morphology

from run_benchmarks import describe_revision, text_of


def labels_of(thickness):
    """A call that finds labels alone."""
    return lambda mask, threads: medialvoxel.extract(mask, thickness=thickness, thickness_map=False, threads=threads)


CALLS = {
    "medialvoxel.extract, automatic, all outputs": lambda mask, threads: medialvoxel.extract(mask, vectors=True, threads=threads),
    "medialvoxel.extract, thickness 3, labels alone": labels_of(3),
    "medialvoxel.extract, thickness 5, labels alone": labels_of(5),
    "skimage.morphology.skeletonize (curves)": lambda mask, _: morphology.skeletonize(mask),
    "medialvoxel.mesh": lambda mask, threads: medialvoxel.mesh(mask, threads=threads),
    "skimage.measure.marching_cubes (faces)": lambda mask, _: measure.marching_cubes(mask, 0.5),
    "medialvoxel.distance, inside": lambda mask, threads: medialvoxel.distance(
        mask, boundary="background", region="inside", vectors=True, threads=threads
    ),
    "scipy.ndimage.distance_transform_edt with indices": lambda mask, _: ndimage.distance_transform_edt(
        mask, return_indices=True
    ),
    "medialvoxel.local_thickness, at most 16": lambda mask, threads: medialvoxel.local_thickness(
        mask, largest_ball=16, threads=threads
    ),
}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path(__file__).parent / "results/arrays.json")
    return parser.parse_args()


def gyroid(size, period=64.0, half_width=0.37):
    z, y, x = (2 * np.pi / period * axis for axis in np.ogrid[:size, :size, :size])
    return np.abs(np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)) < half_width


def plan(mask):
    """The calls by name; ours with one thread and with all."""
    for name, call in CALLS.items():
        for threads in (1, os.cpu_count()) if name.startswith("medialvoxel") else (1,):
            yield f"{name}, threads {threads}", lambda call=call, threads=threads: call(mask, threads)


def measure_calls(mask, rounds):
    seconds = {}
    for _ in range(rounds):
        for name, call in plan(mask):
            start, clock = time.perf_counter(), time.process_time()
            call()
            seconds.setdefault(name, []).append((time.perf_counter() - start, time.process_time() - clock))
    return {
        name: {
            "wall_seconds": round(statistics.median(wall for wall, _ in runs), 3),
            "cpu_seconds": round(statistics.median(cpu for _, cpu in runs), 3),
        }
        for name, runs in seconds.items()
    }


def main():
    arguments = parse_arguments()
    mask = gyroid(arguments.size)
    result = {
        "revision": describe_revision(),
        "processor": text_of("/proc/cpuinfo", r"^model name\s*:\s*(.*)$"),
        "cores": os.cpu_count(),
        "load_at_start": os.getloadavg()[0],
        "versions": {
            "python": platform.python_version(),
            "numpy": np.__version__,
            "scipy": scipy.__version__,
            "skimage": skimage.__version__,
            "medialvoxel": medialvoxel.__version__,
        },
        "shape": mask.shape,
        "object_voxels": int(mask.sum()),
        "rounds": arguments.rounds,
        "calls": measure_calls(mask, arguments.rounds),
    }
    arguments.output.write_text(json.dumps(result, indent=2) + "\n")


if __name__ == "__main__":
    main()
