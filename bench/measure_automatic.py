#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What the automatic thickness costs beside a fixed one of 3 voxels; writes one JSON file and prints a table.

Both ways run in turn, round after round, on two phantoms of full size with two threads. Labels of all runs of a way must
be the same bytes.

Usage: bench/measure_automatic.py BUILD [--rounds 5] [--output results/automatic.json]
"""

import argparse
import json
import pathlib
import tempfile

import compare_peers
import run_benchmarks as common

PHANTOMS = {"side-frame": "708,965,325", "cover": "1500,1500,668"}
WAYS = {"fixed": 3, "automatic": "auto"}
MEASURES = {"wall_seconds": "wall s", "cpu_seconds": "CPU s", "peak_bytes": "peak MiB"}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("--rounds", type=int, default=5, help="default 5")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "automatic.json")
    return parser.parse_args()


def measure(arguments, scratch, kind, size):
    volume = scratch / "volume.raw"
    size, phantom = compare_peers.make_phantom(arguments.build, kind, (), size, volume, scratch)
    programs = {
        way: compare_peers.Extraction(arguments.build, volume, size, 2, thickness, labels=set())
        for way, thickness in WAYS.items()
    }
    runs, _ = compare_peers.run_rounds(programs, scratch, arguments.rounds, 3600, 3600)
    results = {
        way: compare_peers.summarize(values, volume.stat().st_size, phantom["object_voxels"]) for way, values in runs.items()
    }
    return {"size": phantom["size"], "results": results}


def print_table(phantoms):
    print("| phantom | measure | fixed 3 | automatic | ratio |\n| --- | --- | --- | --- | --- |")
    for kind, phantom in phantoms.items():
        for measure_name, title in MEASURES.items():
            unit = 1 << 20 if measure_name == "peak_bytes" else 1
            fixed, automatic = (phantom["results"][way][measure_name]["median"] / unit for way in WAYS)
            print(f"| {kind} | {title} | {fixed:.2f} | {automatic:.2f} | {automatic / fixed:.1f} |")


def main():
    arguments = parse_arguments()
    document = common.describe_run(arguments.build, thickness=3, threads=2)
    with tempfile.TemporaryDirectory() as name:
        document["phantoms"] = {
            kind: measure(arguments, pathlib.Path(name), kind, size) for kind, size in PHANTOMS.items()
        }
    arguments.output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print_table(document["phantoms"])


if __name__ == "__main__":
    main()
