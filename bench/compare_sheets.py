#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Compares the sheets and thicknesses of the program with the skeletons of ITKThickness3D and scikit-image.

All get the same volumes: parts whose mid-surface is known (sheet_parts.py), and the engine block of scripts/demo where
it is there. Prints a Markdown table and writes one JSON file; --pictures also draws the slices.

kept       points of the true mid-surface with a cell (of the program) or voxel (of a skeleton) within 1.5 voxels, in
           percent; points near rims are left out
spurious   cells or voxels farther than 1.5 voxels from the true mid-surface, in percent of all
thickness  mean and standard deviation of its error, in voxels, at the others that are away from rims and junctions; the
           program's own rims, which are negative, are left out
CPU s      one thread, the smallest of the rounds; of the program the whole process, of the others the calls alone

Usage: bench/compare_sheets.py BUILD [options]           needs numpy, scipy and the peers
       bench/compare_sheets.py BUILD --make-environment VENV [options]   installs them into VENV, then measures
"""

import argparse
import json
import math
import os
import pathlib
import sys
import tempfile

import compare_peers
import run_benchmarks as common

PEERS = pathlib.Path(__file__).resolve().with_name("sheet_peers.py")
TITLES = {"extract": "MedialVoxel", "itk-thickness3d": "ITKThickness3D", "skimage": "scikit-image"}
FAR = 1.5
ERRORS = ("thickness_mean_error", "thickness_deviation")
ENGINE = "engine block"
ENGINE_SIZE = (256, 256, 110)
ENGINE_LOWER = 72


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False
    )
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("--engine", type=pathlib.Path, default=pathlib.Path("build/demo-data/engine.256x256x110"),
                        help="volume of scripts/demo; default: build/demo-data/engine.256x256x110")  # fmt: skip
    parser.add_argument("--rounds", type=int, default=3, help="default 3")
    parser.add_argument("--make-environment", type=pathlib.Path, metavar="VENV", help="make it, with the peers of PyPI")
    parser.add_argument("--pictures", type=pathlib.Path, metavar="FOLDER", help="draw into it; needs matplotlib")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "sheets.json")
    return parser.parse_args()


def read_voxels(path, kind, size):
    """Of an uncompressed file: its last bytes."""
    import numpy

    count = math.prod(size)
    with open(path, "rb") as file:
        file.seek(-count * numpy.dtype(kind).itemsize, os.SEEK_END)
        return numpy.frombuffer(file.read(), kind).reshape(size[::-1])


class Runner:
    """Runs programs on a headerless volume; a result is a map of the thickness, not a number where nothing is medial."""

    def __init__(self, build, scratch, rounds):
        self.program = common.find_program(build, "medialvoxel")
        self.scratch = scratch
        self.rounds = rounds

    def run(self, name, volume, size):
        """Map, CPU seconds and version."""
        runs = [self._run_once(name, volume, size) for _ in range(self.rounds)]
        return runs[0][0], min(run[1] for run in runs), runs[0][2]

    def _run_once(self, name, volume, size):
        import numpy

        if name == "extract":
            return (*self.extract(volume, size, "auto"), None)
        output = self.scratch / "skeleton.raw"
        command = [sys.executable, PEERS, name, volume, ",".join(map(str, size)), output]
        printed = json.loads(compare_peers.run_child(command, self.scratch, math.inf)[0])
        return read_voxels(output, numpy.float32, size), printed["call_cpu_seconds"], printed["version"]

    def extract(self, volume, size, thickness, smoothing="off", max_pore_size=0):
        """Map and CPU seconds of the program; it gets the volume as it is, unless told otherwise."""
        import numpy

        labels, walls = self.scratch / "labels.mha", self.scratch / "thickness.mha"
        command = [self.program, "extract", volume, labels, "--raw-size", ",".join(map(str, size)), "--raw-type", "uint8"]
        command += ["--thickness", thickness, "--thickness-map", walls, "--threads", 1, "--quiet", "--overwrite"]
        command += ["--max-pore-size", max_pore_size, "--smooth", smoothing]
        measured = compare_peers.run_child(command, self.scratch, math.inf)[1]
        medial = read_voxels(labels, numpy.uint8, size) >= 2
        return numpy.where(medial, read_voxels(walls, numpy.float32, size), numpy.nan), measured["cpu_seconds"]


def judge(part, thickness, shift):
    """The measures of the head of this file; shift: from the index of a cell to its center."""
    import numpy
    from scipy import spatial

    index = numpy.argwhere(numpy.isfinite(thickness))
    points = index[:, ::-1] + shift - (part.size - 1) / 2
    samples = part.samples()
    if len(points) == 0:
        return {"kept_percent": 0.0, "spurious_percent": 0.0, "measured": 0} | dict.fromkeys(ERRORS)
    is_near = part.middle(points) <= FAR
    covered = spatial.KDTree(points).query(samples)[0] <= FAR
    values = thickness[tuple(index.T)]
    error = (values - part.thickness(points))[is_near & (values >= 0)]
    error = error[numpy.isfinite(error)].astype(float)
    errors = [round(float(value), 3) for value in (error.mean(), error.std())] if len(error) else (None, None)
    return {
        "kept_percent": round(100 * float(covered.mean()), 2),
        "spurious_percent": round(100 * float(1 - is_near.mean()), 2),
        "measured": len(error),
    } | dict(zip(ERRORS, errors))


def measure(runner, title, mask, part=None):
    """Results and maps by name of the program."""
    import numpy

    size, volume = mask.shape[::-1], runner.scratch / "volume.raw"
    mask.tofile(volume)
    document, maps = {"part": title, "size": size, "object_voxels": int(numpy.count_nonzero(mask)), "results": {}}, {}
    for name in TITLES:
        maps[name], seconds, version = runner.run(name, volume, size)
        values = maps[name][numpy.isfinite(maps[name])]
        walls = values[values >= 0]
        result = {"cells": len(values), "cpu_seconds": round(seconds, 3), "version": version}
        result["median_thickness"] = round(float(numpy.median(walls)), 3) if len(walls) else None
        if part:
            result |= judge(part, maps[name], 0.5 if name == "extract" else 0.0)
        document["results"][name] = result
        print(f"{title}: {name}: {result}", file=sys.stderr)
    return document, maps


def format_rows(document):
    rows = ["| part | program | cells | kept, % | spurious, % | thickness error | CPU s |", "|" + " --- |" * 7]
    for volume in document["volumes"]:
        for name, result in volume["results"].items():
            words = [volume["part"], TITLES[name], f"{result['cells']}"]
            if "kept_percent" in result:
                words += [f"{result['kept_percent']:.1f}", f"{result['spurious_percent']:.2f}"]
                mean, deviation = result["thickness_mean_error"], result["thickness_deviation"]
                words += ["-" if mean is None else f"{mean:+.2f} ± {deviation:.2f}"]
            else:
                words += ["", "", f"median {result['median_thickness']:.1f}"]
            rows.append("| " + " | ".join([*words, f"{result['cpu_seconds']:.2f}"]) + " |")
    return "\n".join(rows)


def main():
    arguments = parse_arguments()
    if arguments.make_environment:
        python = compare_peers.make_environment(arguments.make_environment)
        environment = str(arguments.make_environment)
        rest = [word for word in sys.argv if not word.startswith("--make-environment") and word != environment]
        os.execv(python, [python, *rest])

    import numpy
    import sheet_parts

    document = common.describe_run(arguments.build, rounds=arguments.rounds, volumes=[])
    masks, maps = {}, {}
    with tempfile.TemporaryDirectory() as name:
        runner = Runner(arguments.build, pathlib.Path(name), arguments.rounds)
        for title, (part, noise) in sheet_parts.PARTS.items():
            mask = sheet_parts.clean(part)
            masks[title] = noise(mask) if noise else mask
            results, maps[title] = measure(runner, title, masks[title], part)
            document["volumes"].append(results)
        if arguments.engine.is_file():
            values = numpy.fromfile(arguments.engine, numpy.uint8).reshape(ENGINE_SIZE[::-1])
            masks[ENGINE] = (values >= ENGINE_LOWER).astype(numpy.uint8)
            results, maps[ENGINE] = measure(runner, ENGINE, masks[ENGINE])
            document["volumes"].append(results)
        else:
            print(f"compare_sheets.py: skipped: {arguments.engine} is not there, scripts/demo makes it", file=sys.stderr)
    arguments.output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print(format_rows(document))
    if arguments.pictures:
        import draw_sheets

        draw_sheets.draw_all(masks, maps, TITLES, arguments.pictures)


if __name__ == "__main__":
    main()
