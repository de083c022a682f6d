#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What smoothing, the survey of a scan, fits of walls, local thickness and meshes cost: CPU seconds of one thread.

All ways run in turn, round after round, with --before those of an earlier build between them. Phantoms become scans:
blurred by a Gaussian of 0.8 voxels, with white noise of 10 % of the contrast. Jobs are planned with and without the survey,
which tells what it costs.

Prints a Markdown table and writes one JSON file.
Usage: bench/measure_gray_walls.py BUILD [--data FOLDER] [options]      needs numpy and scipy; --data: of the real volumes
"""

import argparse
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import tempfile
import zlib

import compare_peers
import numpy as np
import run_benchmarks as common
from scipy import ndimage

# Of real volumes: file, where its packed values begin, size, type, spacing and threshold.
REAL = {
    "engine": ("engine.mha", b"= LOCAL\n", "256,256,110", "uint8", "1,1,1", 72),
    "shell": ("shell.nrrd", b"\n\n", "128,128,225", "uint8", "1,1,1", 65),
    "cranium": ("cranium.mha", b"= LOCAL\n", "256,256,108", "int16", "0.9570312,0.9570312,1.5", 200),
}
PHANTOMS = {"gyroid": "256,256,256", "side-frame": "708,965,325", "cover": "1500,1500,668"}
BACKGROUND, CONTRAST, BLUR, NOISE = 50, 120, 0.8, 0.1
SLAB = 64

MAP = ("--thickness-map", "FILE-thickness.mha")
EXTRACT = ("extract", "IN", "FILE-labels.mha", "--overwrite", "--quiet", "--threads", "1")
PLAN = ("plan", "IN", "FILE-labels.mha", "FILE-job", "--divisions", "4", "--overwrite", "--quiet")
ROUGH = ("--smooth", "off")
# Name: its command; IN is the input with its options, FILE begins the names of outputs.
WAYS = {
    "labels alone": (*EXTRACT, *ROUGH, "--sub-voxel=off"),
    "labels": (*EXTRACT, *ROUGH),
    "smoothed": (*EXTRACT, "--smooth", "on"),
    "on the object": (*EXTRACT, *ROUGH, *MAP, "--sub-voxel=off"),
    "fits": (*EXTRACT, *ROUGH, *MAP),
    "with uncertainty": (*EXTRACT, *ROUGH, *MAP, "--uncertainty-map", "FILE-uncertainty.mha"),
    "local thickness": (*EXTRACT, *ROUGH, "--local-thickness", "FILE-local.mha"),
    "mesh": (*EXTRACT, *ROUGH, "--mesh", "FILE.ply"),
    "solver mesh": ("mesh", "IN", "FILE.inp", "--overwrite", "--quiet", "--threads", "1"),
    "surface": ("surface", "IN", "FILE.glb", "--overwrite", "--quiet", "--threads", "1"),
    "plan": (*PLAN, *ROUGH, *MAP, "--sub-voxel=off"),
    "plan with survey": (*PLAN, *ROUGH, *MAP),
}


def make_scan(mask, size, path):
    """A gray volume of bytes from a mask, slab by slab; the noise repeats itself."""
    shape = tuple(int(n) for n in reversed(size.split(",")))
    mask, margin = np.memmap(mask, np.uint8, "r", shape=shape), 3
    noise = NOISE * np.random.default_rng(5).standard_normal((SLAB, *shape[1:]), np.float32)
    with path.open("wb") as file:
        for z in range(0, shape[0], SLAB):
            first, last = max(0, z - margin), min(z + SLAB + margin, shape[0])
            share = ndimage.gaussian_filter((mask[first:last] != 0).astype(np.float32), BLUR, truncate=margin / BLUR)
            share = share[z - first : z - first + SLAB]
            share += noise[: len(share)]
            np.clip(np.rint(BACKGROUND + CONTRAST * share), 0, 255).astype(np.uint8).tofile(file)


def make_input(arguments, name, scratch):
    """Words of the command, for a volume that can be read in pieces."""
    volume = scratch / "volume.raw"
    if name in REAL:
        file, mark, size, kind, spacing, threshold = REAL[name]
        packed = (arguments.data / file).read_bytes()
        volume.write_bytes(zlib.decompress(packed[packed.index(mark) + len(mark) :], wbits=47))  # zlib or gzip
        words = ["--spacing", spacing]
    else:
        mask, size, kind, threshold, words = scratch / "mask.raw", PHANTOMS[name], "uint8", BACKGROUND + CONTRAST // 2, []
        compare_peers.make_phantom(arguments.build, name, (), size, mask, scratch)
        make_scan(mask, size, volume)
        mask.unlink()
    return [volume, "--raw-size", size, "--raw-type", kind, "--lower", threshold, *words]


def make_command(program, way, words, scratch):
    command = [program]
    for word in WAYS[way]:
        command += words if word == "IN" else [word.replace("FILE", str(scratch / "out"))]
    return [str(word) for word in command]


def run_way(program, way, words, scratch):
    seconds = common.run(make_command(program, way, words, scratch))[1]["cpu_seconds"]
    shutil.rmtree(scratch / "out-job", ignore_errors=True)
    return seconds


def describe(program, words, scratch):
    """What the report says of the measure, and how many cells were measured."""
    path = scratch / "report.json"
    command = [program, "extract", *words, scratch / "out-labels.mha", *ROUGH, "--overwrite", "--quiet", "--report", path]
    command += [word.replace("FILE", str(scratch / "out")) for word in MAP]
    subprocess.run([str(word) for word in command], check=True)
    found = json.loads(path.read_text(encoding="utf-8"))
    return {"medial_cells": found["counts"]["medial_cells"], "measure": found["measure"]}


def measure(arguments, name):
    builds = {"cpu_seconds": arguments.build} | ({"before": arguments.before} if arguments.before else {})
    programs = {key: common.find_program(build, "medialvoxel") for key, build in builds.items()}
    with tempfile.TemporaryDirectory(dir=arguments.scratch) as folder:
        scratch = pathlib.Path(folder)
        words = make_input(arguments, name, scratch)
        case = {"volume": name, "voxels": int(np.prod([int(n) for n in words[2].split(",")]))}
        case |= describe(programs["cpu_seconds"], words, scratch) | {"load_at_start": round(os.getloadavg()[0], 2)}
        # The uncertainty is that of fits.
        known = [way for way in arguments.ways if way != "with uncertainty" or case["measure"]["on"] == "fits"]
        seconds = {key: {way: [] for way in known} for key in programs}
        for number in range(arguments.rounds):
            # Each round begins with another way.
            ways = known[number % len(known) :] + known[: number % len(known)]
            for way in ways:
                for key, program in programs.items():
                    seconds[key][way].append(round(run_way(program, way, words, scratch), 3))
    return case | seconds


def format_seconds(case, way):
    """Before and now, where there was a build before."""
    return " / ".join(f"{statistics.median(case[key][way]):.2f}" for key in ("before", "cpu_seconds") if way in case.get(key, {}))


def format_rows(cases):
    lines = [["volume", "voxels", "medial cells", "measured on", *WAYS]]
    lines.append(["---"] * len(lines[0]))
    for case in cases:
        seconds = {way: format_seconds(case, way) for way in case["cpu_seconds"]}
        lines.append(
            [case["volume"], case["voxels"], case["medial_cells"], case["measure"]["on"], *(seconds.get(way, "") for way in WAYS)]
        )
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("--before", type=pathlib.Path, help="build folder of an earlier revision; default: none")
    parser.add_argument("--data", type=pathlib.Path, help="folder of the real volumes; default: leave them out")
    parser.add_argument("--volumes", nargs="+", choices=[*REAL, *PHANTOMS], default=[*REAL, *PHANTOMS], help="default: all")
    parser.add_argument("--ways", nargs="+", choices=WAYS, default=list(WAYS), help="default: all")
    parser.add_argument("--rounds", type=int, default=3, help="default 3")
    parser.add_argument("--add", action="store_true", help="keep cases of other volumes in the output")
    parser.add_argument("--scratch", type=pathlib.Path, help="folder of the volumes; default: a temporary one")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "gray-walls.json")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    document = common.describe_run(arguments.build, threads=1, blur=BLUR, noise=NOISE)
    names = [name for name in arguments.volumes if arguments.data or name not in REAL]
    kept = json.loads(arguments.output.read_text(encoding="utf-8"))["cases"] if arguments.add else []
    cases = {case["volume"]: case for case in kept} | {name: measure(arguments, name) for name in names}
    document["cases"] = [cases[name] for name in (*REAL, *PHANTOMS) if name in cases]
    arguments.output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print(format_rows(document["cases"]))


if __name__ == "__main__":
    main()
