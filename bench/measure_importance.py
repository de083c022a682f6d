#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What the map of importance costs beside automatic labels, and whether it has the sheet of each thickness; writes one JSON file.

The map is one run. Cells from pi / 2 times a thickness on are compared with the medial cells of a run with this thickness.

Usage: bench/measure_importance.py BUILD DATA [--rounds 3] [--volumes engine] [--output results/importance.json]
Needs NumPy. Lengths are in the units of the spacing: millimeters for the cranium.
"""

import argparse
import json
import pathlib
import tempfile

import compare_peers
import numpy as np
import run_benchmarks as common
from measure_tiles import SCANS

THICKNESSES = (2, 3, 4, 5, 8, 12, 16)
GYROID = "256,256,256"
VOLUMES = ("engine", "cranium", "gyroid")
# Of the same object, and up to the largest thickness.
OPTIONS = ("--smooth", "off", "--max-pore-size", 32)
WAYS = {"labels": (), "labels and importance": ("--importance", "FILE")}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("data", type=pathlib.Path, help="folder of engine.mha and cranium.mha")
    parser.add_argument("--rounds", type=int, default=3, help="default 3")
    parser.add_argument("--volumes", nargs="+", choices=VOLUMES, default=list(VOLUMES), help="default: all")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "importance.json")
    return parser.parse_args()


def find_volume(arguments, name, scratch):
    """The words of the program that read it."""
    if name in SCANS:
        file, lower = SCANS[name]
        return [arguments.data / file, "--lower", lower]
    volume = scratch / "volume.raw"
    size, _ = compare_peers.make_phantom(arguments.build, name, (), GYROID, volume, scratch)
    return [volume, "--raw-size", size, "--raw-type", "uint8"]


def read(path, kind):
    return np.frombuffer(path.read_bytes().split(b"ElementDataFile = LOCAL\n", 1)[1], kind)


def measure(arguments, name, scratch):
    names = ("labels.mha", "report.json", "importance.mha", "thresholds.mha")
    labels, report, importance, thresholds = (scratch / name for name in names)
    volume, *options = find_volume(arguments, name, scratch)
    command = [common.find_program(arguments.build, "medialvoxel"), "extract", volume, labels, *options, *OPTIONS]
    command += ["--overwrite", "--quiet", "--threads", 1]

    def run(*words):
        return compare_peers.run_child([*command, *words], scratch, 7200)[1]

    automatic = ("--max-thickness", max(THICKNESSES), "--report", report)
    runs = {way: [] for way in WAYS}
    for _ in range(arguments.rounds):
        for way, words in WAYS.items():
            runs[way].append(run(*automatic, *(importance if word == "FILE" else word for word in words)))
    told = json.loads(report.read_text(encoding="utf-8"))
    voxels = int(np.prod(told["input"]["size"]))
    row = {way: compare_peers.summarize(values, voxels, told["counts"]["object_voxels"]) for way, values in runs.items()}
    median = {way: row[way]["cpu_seconds"]["median"] for way in WAYS}
    row["ratio"] = round(median["labels and importance"] / median["labels"], 3)
    lengths = read(importance, "<f4")
    run(*automatic, "--importance-threshold", thresholds)
    chosen = (lengths > 0) & (lengths >= read(thresholds, "<f4"))
    row["automatic"] = {"medial_cells": int(chosen.sum()), "different_cells": int(((read(labels, np.uint8) >= 2) != chosen).sum())}
    row["thicknesses"] = {}
    for thickness in THICKNESSES:
        seconds = run("--thickness", thickness)["cpu_seconds"]
        medial = read(labels, np.uint8) >= 2
        chosen = lengths >= np.float32(np.pi / 2 * thickness)
        row["thicknesses"][thickness] = {
            "medial_cells": int(medial.sum()), "different_cells": int((medial != chosen).sum()), "cpu_seconds": round(seconds, 3)
        }  # fmt: skip
    print(name, median, row["ratio"], row["automatic"], {key: value["different_cells"] for key, value in row["thicknesses"].items()}, flush=True)
    return row


def main():
    arguments = parse_arguments()
    document = common.describe_run(arguments.build, threads=1, volumes={})
    for name in arguments.volumes:
        with tempfile.TemporaryDirectory() as folder:
            document["volumes"][name] = measure(arguments, name, pathlib.Path(folder))
    arguments.output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print(arguments.output)


if __name__ == "__main__":
    main()
