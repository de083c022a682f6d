#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What the topology of the object costs: labels with and without --same-topology, one thread; writes one JSON file.

Both ways run in turn, round after round. Scans are unpacked in each run. The cover is a phantom of 1500 x 1500 x 668 voxels,
which takes 6 GB of scratch space.

Usage: bench/measure_topology.py BUILD DATA [--rounds 5] [--volumes cover] [--output results/topology-cost.json]
"""

import argparse
import json
import math
import pathlib
import tempfile

import compare_peers
import run_benchmarks as common
from measure_tiles import SCANS

COVER = "1500,1500,668"
WAYS = {"labels": (), "same topology": ("--same-topology",)}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("data", type=pathlib.Path, help="folder of engine.mha, shell.nrrd and cranium.mha")
    parser.add_argument("--rounds", type=int, default=5, help="default 5")
    parser.add_argument("--volumes", nargs="+", choices=[*SCANS, "cover"], default=list(SCANS), help="default: the scans")
    parser.add_argument("--scratch", type=pathlib.Path, help="folder of the volumes; default: a temporary one")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "topology-cost.json")
    return parser.parse_args()


def find_volume(arguments, name, scratch):
    """Its file, and the options that read it."""
    if name in SCANS:
        file, lower = SCANS[name]
        return arguments.data / file, ("--lower", lower)
    volume = scratch / "volume.raw"
    size, _ = compare_peers.make_phantom(arguments.build, name, (), COVER, volume, scratch)
    return volume, ("--raw-size", size, "--raw-type", "uint8")


def measure(arguments, name, scratch):
    volume, options = find_volume(arguments, name, scratch)
    program, report = common.find_program(arguments.build, "medialvoxel"), scratch / "report.json"
    runs = {way: [] for way in WAYS}
    for _ in range(arguments.rounds):
        for way, words in WAYS.items():
            command = [program, "extract", volume, scratch / "labels.mha", *options, "--threads", 1, *words]
            measured = compare_peers.run_child([*command, "--report", report, "--overwrite", "--quiet"], scratch, 7200)[1]
            told = json.loads(report.read_text(encoding="utf-8"))
            planned = {"planned_bytes": told["planned_peak_bytes"], "topology_seconds": told["seconds"].get("topology", 0)}
            runs[way].append({**measured, **planned})
    voxels = math.prod(told["input"]["size"])
    row = {way: compare_peers.summarize(values, voxels, told["counts"]["object_voxels"]) for way, values in runs.items()}
    median = {way: row[way]["cpu_seconds"]["median"] for way in WAYS}
    row["ratio"] = round(median["same topology"] / median["labels"], 3)
    print(name, median, row["ratio"], told["topology"])
    return {**row, "topology": told["topology"], "medial_cells": told["counts"]["medial_cells"]}


def main():
    arguments = parse_arguments()
    document = common.describe_run(arguments.build, threads=1, volumes={})
    for name in arguments.volumes:
        with tempfile.TemporaryDirectory(dir=arguments.scratch) as folder:
            document["volumes"][name] = measure(arguments, name, pathlib.Path(folder))
    arguments.output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print(arguments.output)


if __name__ == "__main__":
    main()
