#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Time of the filter from Python and from C++ on the same volume in memory, in turn; prints JSON.

Usage: bench/compare_python.py BUILD PYTHON VOLUME X,Y,Z [--rounds N]
PYTHON: the interpreter of an environment with itk-medialvoxel. VOLUME: headerless, of type uint8. Both programs time one
Update() of MedialVoxelImageFilter with thickness 3; ratio is the median of Python by that of C++.
"""

import argparse
import json
import os
import pathlib
import statistics
import subprocess

from run_benchmarks import describe_machine, describe_revision, find_program

FROM_PYTHON = """
import json, sys, time
import itk, numpy
size = [int(length) for length in sys.argv[2].split(",")]
image = itk.image_view_from_array(numpy.fromfile(sys.argv[1], "uint8").reshape(size[::-1]))
medial = itk.MedialVoxelImageFilter.New(image, thickness=3.0)
start, clock = time.perf_counter(), time.process_time()
medial.Update()
seconds, cpu = time.perf_counter() - start, time.process_time() - clock
print(json.dumps({"filter_seconds": seconds, "filter_cpu_seconds": cpu}))
"""


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("python", type=pathlib.Path)
    parser.add_argument("volume", type=pathlib.Path)
    parser.add_argument("size")
    parser.add_argument("--rounds", type=int, default=5)
    return parser.parse_args()


def measure(command):
    run = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=True)
    return json.loads(run.stdout)


def main():
    arguments = parse_arguments()
    commands = {
        "cxx": [find_program(arguments.build, "medialvoxel-filter"), arguments.volume, arguments.size],
        "python": [arguments.python, "-B", "-c", FROM_PYTHON, arguments.volume, arguments.size],
    }
    runs = {name: [] for name in commands}
    loads = []
    for _ in range(arguments.rounds):
        loads.append(round(os.getloadavg()[0], 2))
        for name, command in commands.items():
            runs[name].append(measure(command))
    result = {"revision": describe_revision(), "machine": describe_machine(arguments.build), "load": loads}
    for key in ("filter_seconds", "filter_cpu_seconds"):
        medians = {name: statistics.median(run[key] for run in runs[name]) for name in runs}
        result[key] = {name: round(seconds, 4) for name, seconds in medians.items()}
        result[key]["ratio"] = round(medians["python"] / medians["cxx"], 3)
    print(json.dumps(result, indent=2))


if __name__ == "__main__":
    main()
