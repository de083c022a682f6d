#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Which work an extraction spends its time on, by samples of a profiler, now and with an earlier build; writes one JSON file.

Runs with one thread: a fixed thickness, the automatic one, and a mesh; on the side frame also a large thickness, and the
distances of all voxels; on random blobs the automatic thickness alone; on real volumes, with --data, a thickness map on
gray values and a mesh for a solver. A sample counts for the function that runs, and
functions are grouped by their names. Both builds run in turn, round after round, and labels of phantoms are compared.
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
import measure_gray_walls
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
# Of walls on gray values and of meshes for solvers, before the others.
WALL_GROUPS = {
    "system: reading, writing, pages": GROUPS["system: reading, writing, pages"],
    "survey of the scan": r"BlockLook|ScanSurvey|ScanSamples|Dilat",
    "normals of walls": r"GrayNormals|FindGradients|AddRows",
    "samples, fits and crossings of walls": r"Gray|WallFit\b|FitSums|PutSamples|SumOf|RefineWalls|WallPoints",
    "nodes on walls": r"WallFitting",
    "nearest triangles": r"SheetTree|SheetDistances|NearestOfTriangle",
    "coarsening": r"Decimation|SheetLines|SheetSizes|CoarsenPart|SheetCoarsening",
    "remeshing": r"Remesh|TriangleComplex|SheetWitnesses|ComplexDivision|Jacobian|RimExten|RimLines",
    "elements": r"ShellElement|ElementSmoothing|SmoothElements|Pairing|LoneTriangle|ShellQuality|WarpageOf|Aspect",
    "mesh": GROUPS["mesh"],
    "labels, and other": r"",
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
# Of measure_gray_walls.py
WALL_WAYS = {"thickness map": "fits", "solver mesh": "solver mesh"}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("--before", type=pathlib.Path, help="build folder of an earlier revision; default: none")
    parser.add_argument("--before-commit", default="unknown", help="its revision, for the file")
    parser.add_argument("--data", type=pathlib.Path, help="folder of the real volumes; default: leave them out")
    parser.add_argument("--rounds", type=int, default=3, help="default 3")
    cases = [*CASES, *(f"walls of {name}" for name in measure_gray_walls.REAL)]
    parser.add_argument("--cases", nargs="+", choices=cases, default=cases, help="default: all")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "profile.json")
    return parser.parse_args()


def group_of(function, groups):
    return next(name for name, pattern in groups.items() if re.search(pattern, function))


def count_samples(command, scratch, groups=GROUPS):
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
            counts[group_of(function.strip(), groups)] += int(number)
    return counts


def seconds_of(rounds, groups=GROUPS):
    """CPU seconds of each group, medians of the rounds."""
    return {
        name: round(statistics.median(counts[name] for counts in rounds) / SAMPLES_PER_SECOND, 4) for name in groups
    }


def list_builds(arguments):
    return {"now": arguments.build} | ({"before": arguments.before} if arguments.before else {})


def measure_walls(arguments, scratch, name):
    words = measure_gray_walls.make_input(arguments, name, scratch)
    result = {}
    for way, known in WALL_WAYS.items():
        rounds = {which: [] for which in list_builds(arguments)}
        for _ in range(arguments.rounds):
            for which, build in list_builds(arguments).items():
                command = measure_gray_walls.make_command(common.find_program(build, "medialvoxel"), known, words, scratch)
                rounds[which].append(count_samples(command, scratch, WALL_GROUPS))
        result[way] = {which: seconds_of(counts, WALL_GROUPS) for which, counts in rounds.items()}
    return {"source": measure_gray_walls.REAL[name][0], "seconds": result}


def measure(arguments, scratch, name):
    volume, size = measure_automatic.make_volume(arguments, scratch, name)
    case = measure_automatic.CASES[name]
    builds = list_builds(arguments)
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
    phantoms = [name for name in arguments.cases if name in CASES]
    phantoms = [name for name in phantoms if arguments.data or "," in measure_automatic.CASES[name].source]
    walls = [name for name in measure_gray_walls.REAL if arguments.data and f"walls of {name}" in arguments.cases]
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        document["cases"] = {name: measure(arguments, scratch, name) for name in phantoms}
        document["cases"] |= {f"walls of {name}": measure_walls(arguments, scratch, name) for name in walls}
    arguments.output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print(arguments.output)


if __name__ == "__main__":
    main()
