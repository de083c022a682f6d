#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Which work an extraction spends its time on, by samples of a profiler, now and with an earlier build; writes one JSON file.

Runs with one thread: a fixed thickness, the automatic one, and a mesh; on the side frame also a large thickness, and the
distances of all voxels; on random blobs the automatic thickness alone. A sample counts for the function that runs, and
functions are grouped by their names. Both builds run in turn, round after round, and their labels are compared.
Needs perf of Linux.

Usage: bench/measure_profile.py BUILD [--before BUILD] [--data FOLDER] [--output results/profile.json]
"""

import argparse
import collections
import json
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

import compare_peers
import measure_automatic
import run_benchmarks as common

SAMPLES_PER_SECOND = 999

# The first group whose pattern is found in the name of a function has its samples.
GROUPS = {
    "system: reading, writing, pages": r"^\[k\]",
    "mesh": r"Surface|Isosurface|Smooth(?!ed)|MeshWriter|Vtp|MeasureThickness|NontrivialEdges|LimitThresholds|FindCell|LookAt",
    "distances of all voxels": r"DistanceTransform|SearchLanes|WriteFloats|LengthTask",
    "voxels around a tile whose balls may reach it": r"ReachingVoxels",
    "nearest boundary points": r"FeatureTransform|SearchOffsets|RowPass|NearestSite|FindSmallestSum|Features::|ColumnPass",
    "pairs of cells": r"NontrivialCells|WidestDiagonals|CellPairs|Joint\w+::(Collect|AddCell)|DualCell|GroupAt",
    "inscribed balls, thresholds": r"InscribedBall|BallSieve|LocalThreshold",
    "components of the boundary": r"BoxComponents|BlockSeparation|SeparateByBlocks|JudgeGroup|FindSeparated",
    "floods of words": r"Flood|LabelShortPair|BoundCells|LabelAtOnce|LabelByLength",
    "neighbors and path searches": r"PathSearch|Separation|\w+Neighbors|PathLengthTo|Edges?Between|Geodesic|BoundaryGraph|Landmark|PairDecision",
    "labels and walls": r"TileLabels|TileResult|Thickness|MeasureWalls|WriteLabels|RankedBits|GetStep",
    "window: bits, boundary, specks, roughness": r"MovingWindow|SmallComponents|ComponentChange|ComputeBoundary|PackRow|Roughness|MedialVoxelBits::",
    "other": r"",
}
# Thickness and further options, as in measure_automatic.py.
OPTIONS = measure_automatic.CASES["side-frame"].ways
WAYS = {"thickness 3": OPTIONS["fixed"], "automatic": OPTIONS["automatic"], "with a mesh": OPTIONS["with a mesh"]}
FURTHER_WAYS = {"thickness 8": OPTIONS["thickness 8"], "with distances": (*OPTIONS["fixed"], "--distance", "FILE.mha")}
CASES = {
    "side-frame": WAYS | FURTHER_WAYS,
    "gyroid": WAYS,
    "engine": WAYS,
    "blobs": {"automatic": OPTIONS["automatic"]},
}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("--before", type=pathlib.Path, help="build folder of an earlier revision; default: none")
    parser.add_argument("--before-commit", default="unknown", help="its revision, for the file")
    parser.add_argument("--data", type=pathlib.Path, help="folder of the real volumes; default: leave them out")
    parser.add_argument("--rounds", type=int, default=3, help="default 3")
    parser.add_argument("--cases", nargs="+", choices=CASES, default=list(CASES), help="default: all")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "profile.json")
    return parser.parse_args()


def group_of(function):
    return next(name for name, pattern in GROUPS.items() if re.search(pattern, function))


def count_samples(command, scratch):
    """Samples by group of one run."""
    samples = scratch / "perf.data"
    record = ["perf", "record", "--quiet", "--output", samples, "--event", "cpu-clock", "--freq", SAMPLES_PER_SECOND, "--"]
    subprocess.run([str(word) for word in [*record, *command]], check=True, stdout=subprocess.DEVNULL)
    report = ["perf", "report", "--input", samples, "--stdio", "--no-children", "--fields", "sample,symbol", "--field-separator", "\t"]
    text = subprocess.run([str(word) for word in report], check=True, capture_output=True, text=True).stdout
    counts = collections.Counter()
    for line in text.splitlines():
        number, separator, function = line.partition("\t")
        if separator and number.strip().isdigit():
            counts[group_of(function.strip())] += int(number)
    return counts


def seconds_of(rounds):
    """CPU seconds of each group, medians of the rounds."""
    return {
        name: round(statistics.median(counts[name] for counts in rounds) / SAMPLES_PER_SECOND, 4) for name in GROUPS
    }


def measure(arguments, scratch, name):
    volume, size = measure_automatic.make_volume(arguments, scratch, name)
    case = measure_automatic.CASES[name]
    builds = {"now": arguments.build} | ({"before": arguments.before} if arguments.before else {})
    result, labels = {}, {}
    for way, options in CASES[name].items():
        words = [str(word).replace("FILE", str(scratch / "extra")) for word in options]
        commands = {
            which: compare_peers.Extraction(build, volume, size, 1, *words, *case.options, scratch=scratch)
            for which, build in builds.items()
        }
        rounds = {which: [] for which in builds}
        for _ in range(arguments.rounds):
            for which, extraction in commands.items():
                rounds[which].append(count_samples(extraction.command, scratch))
                labels.setdefault(way, set()).add(common.sha256_of(extraction.output))
                extraction.output.unlink()
        if len(labels[way]) > 1:
            sys.exit(f"measure_profile.py: labels of {name}, {way}, differ")
        result[way] = {which: seconds_of(counts) for which, counts in rounds.items()}
    return {"source": case.source, "seconds": result}


def main():
    arguments = parse_arguments()
    if not shutil.which("perf"):
        sys.exit("measure_profile.py: needs perf (Debian: linux-perf)")
    document = common.describe_run(arguments.build, rounds=arguments.rounds, threads=1)
    document["before"] = arguments.before_commit
    names = [name for name in arguments.cases if arguments.data or "," in measure_automatic.CASES[name].source]
    with tempfile.TemporaryDirectory() as folder:
        document["cases"] = {name: measure(arguments, pathlib.Path(folder), name) for name in names}
    arguments.output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print(arguments.output)


if __name__ == "__main__":
    main()
