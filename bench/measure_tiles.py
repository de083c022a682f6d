#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""How far threads can help: an extraction on paper with any number of threads, and for real with few; writes one JSON file.

On paper the engine's own schedule hands out all work to so many threads: reading and packing the input, windows, boundary,
tiles with their results. One thread does it, and each piece of work is over after the processor time that it took.
Memory and caches that threads share, and writing the file, are left out, so that the numbers are bounds. Real runs of
the engine on the same volume, in turn with those on paper, say how close they are.

Usage: bench/measure_tiles.py BUILD [--output results/tiles.json]
"""

import argparse
import json
import os
import pathlib
import statistics
import sys
import tempfile

import run_benchmarks as common

THREADS = (1, 2, 4, 8, 16, 32, 64)
# Kind of medialvoxel-phantom and its size.
VOLUMES = {"side-frame": "708,965,325", "solids": "512,512,512", "cover": "1500,1500,668"}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("--kinds", nargs="+", choices=VOLUMES, default=list(VOLUMES), help="default: all")
    parser.add_argument("--size", help="X,Y,Z instead of the sizes of the kinds, to try the script")
    parser.add_argument("--rounds", type=int, default=5, help="default 5")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "tiles.json")
    return parser.parse_args()


def describe_tiles(run):
    tiles = run["tile_seconds"]
    return {
        "tiles": len(tiles),
        "pieces": run["pieces"],
        "milliseconds_of_a_tile": {
            "mean": round(1e3 * statistics.mean(tiles), 3),
            "median": round(1e3 * statistics.median(tiles), 3),
            "largest": round(1e3 * max(tiles), 3),
        },
    }


def median_of(runs, key):
    return round(statistics.median(run[key] for run in runs), 4)


def summarize(simulated, real):
    """Medians of all rounds by number of threads."""
    alone = median_of(simulated[1], "seconds")
    on_paper = {
        str(n): {
            **describe_tiles(runs[0]),
            "seconds": median_of(runs, "seconds"),
            "speed_up": round(alone / median_of(runs, "seconds"), 2),
            "work_cpu_seconds": {
                name: round(statistics.median(run["work"].get(name, 0.0) for run in runs), 4) for name in runs[0]["work"]
            },
        }
        for n, runs in simulated.items()
    }
    keys = ("wall_seconds", "cpu_seconds", "thread_efficiency", "load_before")
    measured = {str(n): {key: median_of(runs, key) for key in keys} for n, runs in real.items()}
    return {"on_paper": on_paper, "measured": measured}


def measure(arguments, folder, kind):
    volume = folder / "volume.raw"
    size = arguments.size or VOLUMES[kind]
    common.run([common.find_program(arguments.build, "medialvoxel-phantom"), kind, str(volume), "--size", size])
    tiles = common.find_program(arguments.build, "medialvoxel-tiles")

    def run(how, threads):
        text, times = common.run([tiles, how, str(volume), size, str(threads)])
        return {**json.loads(text), "load_before": times["load_before"]}

    simulated = {n: [] for n in THREADS}
    real = {n: [] for n in (1, os.cpu_count())}
    for _ in range(arguments.rounds):
        for n, runs in simulated.items():
            runs.append(run("simulate", n))
        for n, runs in real.items():
            runs.append(run("run", n))
    volume.unlink()
    result = {"size": [int(n) for n in size.split(",")], **summarize(simulated, real)}
    print(kind, {n: paper["speed_up"] for n, paper in result["on_paper"].items()}, file=sys.stderr)
    return result


def main():
    arguments = parse_arguments()
    document = common.describe_run(arguments.build, thickness=3, rounds=arguments.rounds)
    with tempfile.TemporaryDirectory() as folder:
        document["volumes"] = {kind: measure(arguments, pathlib.Path(folder), kind) for kind in arguments.kinds}
    arguments.output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print(arguments.output)


if __name__ == "__main__":
    main()
