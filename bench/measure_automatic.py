#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What the automatic thickness costs beside a fixed one of 3 voxels, and a mesh and a report beside it; writes one JSON
file and prints a table.

All ways run in turn, round after round, on phantoms of full size. Labels of all runs of a way must be the same bytes.

Usage: bench/measure_automatic.py BUILD [--rounds 5] [--output results/automatic.json]
"""

import argparse
import json
import pathlib
import tempfile

import compare_peers
import run_benchmarks as common

PHANTOMS = {"side-frame": "708,965,325", "cover": "1500,1500,668", "gyroid": "256,256,256"}
# The thickness and further options; FILE is a new file in the scratch folder.
WAYS = {
    "fixed": (3,),
    "automatic": ("auto",),
    "with a mesh": ("auto", "--mesh", "FILE.vtp"),
    "with report, page and picture": ("auto", "--report", "FILE.json", "--html", "FILE.html", "--preview", "FILE.png"),
}
MEASURES = {"wall_seconds": "wall s", "cpu_seconds": "CPU s", "peak_bytes": "peak MiB"}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("--rounds", type=int, default=5, help="default 5")
    parser.add_argument("--threads", type=int, default=2, help="default 2")
    parser.add_argument("--kinds", nargs="+", choices=PHANTOMS, default=list(PHANTOMS), help="default: all")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "automatic.json")
    return parser.parse_args()


def measure(arguments, scratch, kind, size):
    volume = scratch / "volume.raw"
    size, phantom = compare_peers.make_phantom(arguments.build, kind, (), size, volume, scratch)
    programs = {
        way: compare_peers.Extraction(
            arguments.build,
            volume,
            size,
            arguments.threads,
            *(str(word).replace("FILE", str(scratch / "extra")) for word in words),
            labels=set(),
        )
        for way, words in WAYS.items()
    }
    runs, _ = compare_peers.run_rounds(programs, scratch, arguments.rounds, 3600, 3600)
    results = {
        way: compare_peers.summarize(values, volume.stat().st_size, phantom["object_voxels"]) for way, values in runs.items()
    }
    return {"size": phantom["size"], "results": results}


def print_table(phantoms):
    ways = list(WAYS)
    ratios = ["automatic to fixed", *(f"{way} to automatic" for way in ways[2:])]
    print("| phantom | measure | " + " | ".join(ways + ratios) + " |")
    print("| --- " * (2 * len(ways) + 1) + "|")
    for kind, phantom in phantoms.items():
        for measure_name, title in MEASURES.items():
            unit = 1 << 20 if measure_name == "peak_bytes" else 1
            values = [phantom["results"][way][measure_name]["median"] / unit for way in ways]
            ratios = [values[1] / values[0], *(value / values[1] for value in values[2:])]
            print(f"| {kind} | {title} | " + " | ".join(f"{value:.2f}" for value in (*values, *ratios)) + " |")


def main():
    arguments = parse_arguments()
    document = common.describe_run(arguments.build, thickness=3, threads=arguments.threads)
    with tempfile.TemporaryDirectory() as name:
        document["phantoms"] = {
            kind: measure(arguments, pathlib.Path(name), kind, size) for kind, size in PHANTOMS.items() if kind in arguments.kinds
        }
    arguments.output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print_table(document["phantoms"])


if __name__ == "__main__":
    main()
