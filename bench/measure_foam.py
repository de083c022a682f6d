#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Time and memory of the map of local thickness of a foam, with a limit on the memory; writes JSON.

The foam is a periodic block of cells with walls of 4 to 8 voxels, repeated. Runs with other divisions and threads must give
the same bytes. The memory is what the system tells of the whole process, and the limit holds for the labels as well.

Usage: bench/measure_foam.py BUILD [options]                 needs numpy and scipy
"""

import argparse
import json
import pathlib
import tempfile

import numpy as np
import run_benchmarks as common
from scipy.spatial import cKDTree

BLOCK = 300
CELLS = 220
LIMIT = "1G"
# Further options of each run; the first is timed with one thread.
RUNS = (("--threads", "1"), ("--threads", "2"), ("--threads", "2", "--divisions", "7"))


def make_block():
    """Walls where the two nearest centers are nearly as far; a face lies halfway between two."""
    random = np.random.default_rng(11)
    centers, widths = random.uniform(0, BLOCK, (CELLS, 3)), random.uniform(4, 8, CELLS)
    tree = cKDTree(centers, boxsize=BLOCK)
    y, x = np.mgrid[:BLOCK, :BLOCK]
    block = np.empty((BLOCK, BLOCK, BLOCK), np.uint8)
    for z in range(BLOCK):
        places = np.stack([np.full(x.size, z), y.ravel(), x.ravel()], 1).astype(float)
        distances, nearest = tree.query(places, k=2, workers=-1)
        block[z] = (distances[:, 1] - distances[:, 0] < widths[nearest].mean(1)).reshape(BLOCK, BLOCK)
    return block


def write_foam(path, size):
    block = make_block()
    rows = np.tile(block, (1, -(-size[1] // BLOCK), -(-size[0] // BLOCK)))[:, : size[1], : size[0]]
    with path.open("wb") as file:
        for z in range(0, size[2], BLOCK):
            rows[: size[2] - z].tofile(file)
    return float(block.mean())


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("--size", default="1500,1500,1200", help="default 1500,1500,1200")
    parser.add_argument("--runs", type=int, default=len(RUNS), help=f"how many of {RUNS}; default: all")
    parser.add_argument("--scratch", type=pathlib.Path, help="folder of the volumes; default: a temporary one")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "foam.json")
    return parser.parse_args()


def measure(program, volume, arguments, more):
    outputs = [volume.with_name(name) for name in ("labels.mha", "local.mha")]
    report = volume.with_name("report.json")
    command = [program, "extract", volume, outputs[0], "--local-thickness", outputs[1], "--local-thickness-method", "sphere", "--raw-size", arguments.size]
    command += ["--raw-type", "uint8", "--memory", LIMIT, "--report", report, "--overwrite", "--quiet", *more]
    _, times = common.run([str(word) for word in command])
    written = json.loads(report.read_text(encoding="utf-8"))
    return times | {
        "options": more,
        "peak_mib": round(written["peak_memory_bytes"] / 2**20),
        "divisions": written["divisions"],
        "local_thickness": written["local_thickness"],
        "sha256": [common.sha256_of(path) for path in outputs],
    }


def main():
    arguments = parse_arguments()
    size = [int(n) for n in arguments.size.split(",")]
    program = common.find_program(arguments.build, "medialvoxel")
    with tempfile.TemporaryDirectory(dir=arguments.scratch) as folder:
        volume = pathlib.Path(folder) / "foam.raw"
        document = common.describe_run(arguments.build, size=size, limit=LIMIT)
        document["object_share"] = round(write_foam(volume, size), 4)
        document["runs"] = []
        for more in RUNS[: arguments.runs]:
            run = measure(program, volume, arguments, more)
            document["runs"].append(run)
            arguments.output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
            print(f"{' '.join(more)}: {run['cpu_seconds']:.0f} s CPU, {run['wall_seconds']:.0f} s, peak {run['peak_mib']} MiB", flush=True)
    if len({tuple(run["sha256"]) for run in document["runs"]}) > 1:
        raise SystemExit("measure_foam.py: two runs gave different bytes")


if __name__ == "__main__":
    main()
