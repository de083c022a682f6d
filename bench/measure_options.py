#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What the options of medialvoxel extract cost on one volume: CPU seconds and peak memory; writes one JSON file.

All ways run in turn, round after round. Labels of all runs must be the same bytes.

Usage: bench/measure_options.py BUILD [--rounds 5] [--size X,Y,Z] [--output results/options.json]
"""

import argparse
import json
import pathlib
import tempfile

import compare_peers
import run_benchmarks as common

# FILE is a new file in the scratch folder.
WAYS = {
    "labels": (),
    "with `--report`": ("--report", "FILE.json"),
    "with `--preview`": ("--preview", "FILE.png"),
    "with `--html`": ("--html", "FILE.html"),
    "with `--vectors`": ("--vectors", "FILE.mha"),
    "with `--distance`": ("--distance", "FILE.mha"),
    "with `--sparse`": ("--sparse",),
    "with `--divisions 8`": ("--divisions", "8"),
    "with `--memory 64M`": ("--memory", "64M"),
    "with `--memory 32M`": ("--memory", "32M"),
}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("--rounds", type=int, default=5, help="default 5")
    parser.add_argument("--size", default="708,965,325", help="of the side frame; default 708,965,325")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "options.json")
    return parser.parse_args()


# Reading the volume and writing so many bytes per voxel.
FLOORS = {"floor of labels": 1, "floor of labels and distances": 1 + 4, "floor of labels and vectors": 1 + 12}


def make_floors(arguments, volume, size):
    copy = volume.with_name("floor.raw")
    command = [common.find_program(arguments.build, "medialvoxel-floor"), volume, size, 1, copy, "--bytes-per-voxel"]
    return {name: compare_peers.Program([*command, number], copy) for name, number in FLOORS.items()}


def measure(arguments, scratch):
    volume, labels = scratch / "volume.raw", set()
    size, phantom = compare_peers.make_phantom(arguments.build, "side-frame", (), arguments.size, volume, scratch)
    programs = {
        way: compare_peers.Extraction(
            arguments.build, volume, size, 1, 3, *(word.replace("FILE", str(scratch / "extra")) for word in words), labels=labels
        )
        for way, words in WAYS.items()
    } | make_floors(arguments, volume, size)
    runs, _ = compare_peers.run_rounds(programs, scratch, arguments.rounds, 3600, 3600)
    return {
        "size": phantom["size"],
        "results": {
            way: compare_peers.summarize(values, volume.stat().st_size, phantom["object_voxels"])
            for way, values in runs.items()
        },
    }


def main():
    arguments = parse_arguments()
    document = common.describe_run(arguments.build, thickness=3, threads=1)
    with tempfile.TemporaryDirectory() as name:
        document.update(measure(arguments, pathlib.Path(name)))
    arguments.output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print(arguments.output)


if __name__ == "__main__":
    main()
