#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""How far threads can help: whole runs of the program on paper, with a core for each of any number of threads; one JSON file.

All is on paper but the work: a library (bench/tiles/VirtualCores.cxx) lets one thread run at a time, that whose clock is
earliest, and clocks count processor time. So each thread waits for others as it would with so many cores, from the file to
the file. Memory and caches that cores share, and disks, are left out, so that the numbers are bounds. For each task the file
says what a single core does while all others wait, and what makes cores wait at all.

Usage: bench/measure_tiles.py BUILD [--data FOLDER] [--output results/tiles.json]
"""

import argparse
import json
import pathlib
import re
import statistics
import sys
import tempfile
import zlib

import core_times
import run_benchmarks as common

THREADS = (1, 2, 4, 8, 16, 32, 64)

# Arguments of the program after the volume, and the output.
TASKS = {
    "labels, thickness 3": ("extract", "labels.mha", ["--thickness", "3"]),
    "labels": ("extract", "labels.mha", []),
    "thickness map": ("extract", "labels.mha", ["--thickness-map", "map.mha"]),
    "local thickness": ("extract", "labels.mha", ["--local-thickness", "local.mha"]),
    "mesh of the sheet": ("mesh", "sheet.ply", []),
    "surface": ("surface", "part.ply", []),
    "solver mesh": ("mesh", "elements.inp", []),
}
# Files of the folder of data, and the objects in them.
SCANS = {"engine": ("engine.mha", "72"), "shell": ("shell.nrrd", "65"), "cranium": ("cranium.mha", "200")}
# The engine and its mirror images along each axis: as dense, and eight times as large.
ENGINES = "eight engines"
# Kinds of medialvoxel-phantom, and their sizes.
PHANTOMS = {"gyroid": "256,256,256", "side-frame": "708,965,325", "solids": "512,512,512"}

# What a function does, by a part of its name; the first one that is being called counts.
NAMES = (
    ("UnpackedVolume::Unpack", "unpack the volume"),
    ("ScanSurvey::Run", "survey of the scan"),
    ("MedialVoxelObjectInput::Prepare", "roughness and thick walls"),
    ("InputVolume::Prepare", "roughness and thick walls"),
    ("PartSurface::AddSlice", "slices of the surface"),
    ("MeasurePart", "measures of the surface"),
    ("SurfaceObserver::Commit", "join the sheet"),
    ("SurfaceObserver::Finish", "join the sheet"),
    ("CleanSheet", "clean the sheet"),
    ("SortMesh", "cut the sheet into parts"),
    ("MeshPartition::MeshPartition", "cut the sheet into parts"),
    ("SheetCoarsening::SheetCoarsening", "cut the sheet into parts"),
    ("SheetCoarsening::FitWalls", "nodes on walls"),
    ("WallFitting", "nodes on walls"),
    ("SheetCoarsening::MeasureDistances", "distances of the mesh"),
    ("SheetDistances", "distances of the mesh"),
    ("SheetCoarsening::Coarsen", "coarsen the sheet"),
    ("MedialVoxelMakeElements", "pair triangles"),
    ("ExtendRims", "extend rims"),
    ("MedialVoxelRemesh", "remesh the coarse sheet"),
    ("RemeshSheet", "remesh the coarse sheet"),
    ("MeasureQuality", "quality of the mesh"),
    ("WriteMesh", "write the mesh"),
    ("WallThicknessTask", "paint the local thickness"),
    ("ExtractionTask", "tiles"),
    ("MovingWindow", "windows"),
    ("SlabSchedule", "schedule"),
    ("WriteBehind", "write the volume"),
    ("OutputSet", "write the volume"),
    ("Job::Plan", "plan"),
)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("--data", type=pathlib.Path, help="folder of engine.mha, shell.nrrd and cranium.mha; default: phantoms alone")
    parser.add_argument("--volumes", nargs="+", choices=[*SCANS, ENGINES, *PHANTOMS], help="default: all that there are")
    parser.add_argument("--tasks", nargs="+", choices=TASKS, default=list(TASKS), help="default: all")
    parser.add_argument("--threads", nargs="+", type=int, default=list(THREADS), help="with 1; default: 1 to 64")
    parser.add_argument("--size", help="X,Y,Z instead of the sizes of the phantoms, to try the script")
    parser.add_argument("--rounds", type=int, default=3, help="default 3")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "tiles.json")
    return parser.parse_args()


def mirror_engine(file, volume):
    """Writes the engine beside itself, mirrored along x, y and z; returns its size."""
    header, _, packed = file.read_bytes().partition(b"ElementDataFile = LOCAL\n")
    width, height, depth = (int(n) for n in re.search(rb"DimSize = (\d+) (\d+) (\d+)", header).groups())
    voxels = zlib.decompress(packed)
    rows = [voxels[at : at + width] for at in range(0, len(voxels), width)]
    rows = [row + row[::-1] for row in rows]
    slices = [rows[at : at + height] for at in range(0, len(rows), height)]
    slices = [part + part[::-1] for part in slices]
    volume.write_bytes(b"".join(row for part in slices + slices[::-1] for row in part))
    return f"{2 * width},{2 * height},{2 * depth}"


def make_volume(arguments, folder, name):
    """Its file, and the options that say what is in it."""
    if name in SCANS:
        file, lower = SCANS[name]
        return str(arguments.data / file), ["--lower", lower]
    volume = str(folder / "volume.raw")
    if name == ENGINES:
        file, lower = SCANS["engine"]
        size = mirror_engine(arguments.data / file, pathlib.Path(volume))
        return volume, ["--lower", lower, "--raw-size", size, "--raw-type", "uint8"]
    size = arguments.size or PHANTOMS[name]
    common.run([common.find_program(arguments.build, "medialvoxel-phantom"), name, volume, "--size", size])
    return volume, ["--raw-size", size, "--raw-type", "uint8"]


def medians(runs):
    """Of numbers, and of numbers by name, the largest first, from a millisecond on."""
    result = {}
    for key, value in runs[0].items():
        if not isinstance(value, dict):
            result[key] = round(statistics.median(run[key] for run in runs), 4)
            continue
        names = {name for run in runs for name in run[key]}
        numbers = {name: round(statistics.median(run[key].get(name, 0.0) for run in runs), 4) for name in names}
        result[key] = {name: numbers[name] for name in sorted(numbers, key=numbers.get, reverse=True) if numbers[name] >= 0.001}
    return result


def measure_task(arguments, folder, volume, options, task):
    command, output, own = TASKS[task]
    files = [str(folder / word) if "." in word else word for word in (output, *own)]
    library = next(arguments.build.resolve().rglob("libmedialvoxel-cores.so"))
    words = [common.find_program(arguments.build, "medialvoxel"), command, volume, *files, *options, "--overwrite", "--quiet"]
    runs = {threads: [] for threads in arguments.threads}
    for _ in range(arguments.rounds):
        for threads, own_runs in runs.items():
            own_runs.append(core_times.summarize(core_times.run(library, words, threads), threads, NAMES))
    results = {str(threads): medians(own_runs) for threads, own_runs in runs.items()}
    for result in results.values():
        result["speed_up"] = round(results["1"]["seconds"] / result["seconds"], 2)
    return results


def tell(volume, task, results):
    print(f"{volume}, {task}: {results['1']['seconds']:.2f} s", {n: result["speed_up"] for n, result in results.items()})
    most = results.get("16", results[max(results, key=int)])
    for key in ("serial_seconds", "idle_seconds"):
        print("   ", key, ", ".join(f"{name} {seconds:.3f}" for name, seconds in list(most[key].items())[:6]), flush=True)


def main():
    arguments = parse_arguments()
    names = arguments.volumes or [*((*SCANS, ENGINES) if arguments.data else ()), *PHANTOMS]
    document = common.describe_run(arguments.build, rounds=arguments.rounds, volumes={})
    for name in names:
        with tempfile.TemporaryDirectory() as folder:
            volume, options = make_volume(arguments, pathlib.Path(folder), name)
            tasks = document["volumes"][name] = {}
            for task in arguments.tasks:
                tasks[task] = measure_task(arguments, pathlib.Path(folder), volume, options, task)
                tell(name, task, tasks[task])
    arguments.output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print(arguments.output)


if __name__ == "__main__":
    sys.exit(main())
