#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""How far threads can help: CPU seconds of every tile, handed to any number of threads on paper; writes one JSON file.

Threads take tiles in order, each when it is free, and wait for each other at the end of a layer of tiles, as the engine
has them do; what one thread does between layers (bits of the input, boundary, window) is added. Memory and caches that
threads share are left out, so that the numbers are bounds.

Usage: bench/measure_tiles.py BUILD [--output results/tiles.json]
"""

import argparse
import heapq
import json
import pathlib
import statistics
import sys
import tempfile

import run_benchmarks as common

THREADS = (1, 2, 4, 8, 16, 32)
# Kind of medialvoxel-phantom and its size.
VOLUMES = {"side-frame": "708,965,325", "solids": "512,512,512", "cover": "1500,1500,668"}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("--kinds", nargs="+", choices=VOLUMES, default=list(VOLUMES), help="default: all")
    parser.add_argument("--size", help="X,Y,Z instead of the sizes of the kinds, to try the script")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "tiles.json")
    return parser.parse_args()


def makespan(seconds, threads):
    """When the last tile is done."""
    free = [0.0] * threads
    for tile in seconds:
        heapq.heapreplace(free, free[0] + tile)
    return max(free)


def bounds(layers):
    """Speed-up by threads, of the tiles alone and with what one thread does between them."""
    serial = sum(layer["serial_seconds"] for layer in layers)
    tiles = {n: sum(makespan(layer["tile_seconds"], n) for layer in layers) for n in THREADS}
    return {
        str(n): {"tiles": round(tiles[1] / tiles[n], 2), "all": round((tiles[1] + serial) / (tiles[n] + serial), 2)}
        for n in THREADS
    }


def measure(arguments, folder, kind):
    volume = folder / "volume.raw"
    size = arguments.size or VOLUMES[kind]
    common.run([common.find_program(arguments.build, "medialvoxel-phantom"), kind, str(volume), "--size", size])
    text, _ = common.run([common.find_program(arguments.build, "medialvoxel-tiles"), str(volume), size])
    volume.unlink()
    layers = json.loads(text)["layers"]
    tiles = [seconds for layer in layers for seconds in layer["tile_seconds"]]
    total = sum(tiles)
    print(f"{kind}: {len(tiles)} tiles, {total:.2f} CPU s", file=sys.stderr)
    return {
        "size": [int(n) for n in size.split(",")],
        "layers": len(layers),
        "tiles": len(tiles),
        "tile_cpu_seconds": round(total, 4),
        "serial_cpu_seconds": round(sum(layer["serial_seconds"] for layer in layers), 4),
        "milliseconds_of_a_tile": {
            "mean": round(1e3 * total / len(tiles), 3),
            "median": round(1e3 * statistics.median(tiles), 3),
            "largest": round(1e3 * max(tiles), 3),
        },
        "bound_of_speed_up": bounds(layers),
    }


def main():
    arguments = parse_arguments()
    document = common.describe_run(arguments.build, thickness=3)
    with tempfile.TemporaryDirectory() as folder:
        document["volumes"] = {kind: measure(arguments, pathlib.Path(folder), kind) for kind in arguments.kinds}
    arguments.output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print(arguments.output)


if __name__ == "__main__":
    main()
