#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Thickness of thin walls on gray values: plates, shells, tubes, gyroids and pairs of plates beside a thick wall.

Levels, blur and noise come from the scan: each volume has one part of 8 voxels or more. Plates, tubes and pairs stand in
several directions, each repetition at another place and with its own noise. Figures are those of measure_step_wedge.py.

The threshold is half of the contrast. Walls below 2 voxels, which it misses, are measured at a second one as well, so that
the figures are those of the fit and not of the few cells that noise makes.

Prints Markdown tables and writes one JSON file.
Usage: bench/measure_thin_walls.py BUILD [options]           needs numpy and scipy
"""

import argparse
import multiprocessing
import pathlib
import tempfile
import zlib

import measure_step_wedge as study
import numpy as np
import run_benchmarks as common
import thickness_runs as runs
import virtual_parts as parts
import virtual_scan as scan
import wedge_tables as tables
from virtual_gyroid import GyroidBand

DIRECTIONS = {str(normal): normal for normal in ((0, 0, 1), (1, 2, 5), (1, 1, 1), (1, 1, 0), (2, -3, 7), (5, 1, -4))}
# Blur, kind of noise and its standard deviation in percent of the contrast.
CASES = (
    *((0.5, "white", 10), (0.8, "white", 10), (1.0, "white", 10), (1.0, "white", 0), (0.8, "white", 30)),
    *((0.8, "white", 20), (0.8, "correlated", 20)),
)
THICK = 8
# Walls below this are measured at a threshold of this share of the contrast too, up to this noise in percent.
THIN = 2
LOW = 0.22
LARGEST_NOISE_OF_LOW = 10


def plates(walls):
    """Beside a plate of 8, gaps of 6 voxels and more."""

    def make(direction, shift):
        layers = [(-16.0, THICK), *((-3.0 + 10.5 * k, wall) for k, wall in enumerate(walls))]
        return parts.plates(layers, direction, shift, size=64, half=16.0)

    return make


def pair(wall, gap):
    """Two plates behind a gap, and a plate of 8."""

    def make(direction, shift):
        layers = [(-14.0, THICK), (1.0, wall), (1.0 + wall + gap, wall)]
        part = parts.plates(layers, direction, shift, size=60, half=16.0, gap=gap)
        part.walls = part.walls[1:]
        return part

    return make


def shell(wall, radius):
    """Around a ball."""

    def make(_, shift):
        part = parts.shell(wall, radius, shift)
        part.pieces.append([parts.RoundBand(part.walls[0].band.origin, None, -1, 9)])
        return part

    return make


def tube(wall, radius):
    """Around a rod; both cross the volume."""

    def make(direction, shift):
        center = np.full(3, 23.5) + shift
        band = parts.RoundBand(center, direction, radius - wall / 2, radius + wall / 2)
        rod = parts.RoundBand(center, direction, -1, 6.0)
        return parts.Part((48, 48, 48), [[band], [rod]], [parts.Wall(wall, band)])

    return make


def gyroid(wall, period):
    """Above a plate of 8."""

    def make(_, shift):
        center = np.full(3, 27.5) + shift
        band, upper = GyroidBand(center, period, wall), parts.FlatBand(center, (0, 0, 1), -8, 99)
        base = parts.FlatBand(center, (0, 0, 1), -23, -15)
        return parts.Part((56, 56, 56), [[upper, band], [base]], [parts.Wall(wall, band, (upper,))])

    return make


# Title: how to make it from a direction and a shift, and the title of its rows.
PARTS = {f"plates {walls}": (plates(walls), "plates") for walls in ((0.75, 2, 4), (1, 3), (1.5, 6))}
PARTS |= {f"shell {wall}": (shell(wall, radius), "shells") for wall, radius in ((1, 18.7), (1.5, 21.3), (2, 19.4), (3, 20.6), (4, 21.1))}
PARTS |= {f"tube {wall}": (tube(wall, radius), "tubes") for wall, radius in ((1, 14.2), (2, 14.8), (3, 15.4), (4, 16.1))}
PARTS |= {f"gyroid {wall}": (gyroid(wall, period), "gyroids") for wall, period in ((1.5, 27), (2, 27), (4, 38))}
PARTS |= {f"pair {wall} {gap}": (pair(wall, gap), f"pairs, gap of {gap:g}") for gap in (1, 1.5, 2, 3) for wall in (1.5, 2, 3)}


# Shells and gyroids have no direction; they are measured as often as a plate in two.
TURNED = {name for _, name in PARTS.values() if name not in ("shells", "gyroids")}


def directions_of(title, most):
    return list(DIRECTIONS)[: most if PARTS[title][1] in TURNED else min(most, 2)]


def measure(task):
    """All cases of one part in one direction: (key of the row, direction, sums)."""
    build, title, direction, repetition, levels, cases = task
    random = np.random.default_rng([study.SEED, repetition, zlib.crc32(f"{title} {direction}".encode())])
    make, name = PARTS[title]
    part = make(DIRECTIONS[direction], random.uniform(-0.5, 0.5, 3))
    rays, fine, blurred, result = runs.make_rays(part), part.fill(scan.DIVISION), {}, []
    with tempfile.TemporaryDirectory() as folder:
        program = runs.Program(build, pathlib.Path(folder))
        for sigma, noise, percent in cases:
            if sigma not in blurred:
                blurred[sigma] = scan.blur(fine, sigma)
            values = blurred[sigma] + scan.make_noise(blurred[sigma].shape, percent / 100, noise == "correlated", random)
            values = scan.digitize(values)
            for share in (0.5, LOW):
                walls = [wall for wall in part.walls if share != LOW or wall.thickness < THIN]
                if not walls or (share == LOW and percent > LARGEST_NOISE_OF_LOW):
                    continue
                threshold = scan.BACKGROUND + round(share * scan.CONTRAST)
                found = runs.run_unless_refused(program, values, levels=levels, threshold=threshold)
                if found is None:
                    continue
                sums = runs.judge(part, rays, runs.to_unit(values), found)
                of = name if share != LOW else f"{name}, threshold of {100 * LOW:.0f} %"
                result += [
                    ((of, sigma, noise, percent, wall.thickness), direction, row)
                    for wall, row in zip(part.walls, sums) if wall in walls
                ]  # fmt: skip
    return result, []


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("--repetitions", type=int, default=2, help="of each direction; default 2")
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=list(PARTS), metavar="TITLE", help="default: all")
    parser.add_argument("--directions", type=int, default=len(DIRECTIONS), help="how many of them; default: all")
    parser.add_argument("--cases", nargs="+", type=int, default=range(len(CASES)), help=f"indices of {CASES}; default: all")
    parser.add_argument("--known-levels", action="store_true", help="give the program the levels")
    parser.add_argument("--program-commit", help="commit that the program is of; default: that of this script")
    parser.add_argument("--processes", type=int, default=2, help="default 2")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "thin-walls.json")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    with tempfile.TemporaryDirectory() as folder:
        program = runs.Program(arguments.build, pathlib.Path(folder)).describe(arguments.program_commit)
    levels = (scan.BACKGROUND, scan.BACKGROUND + scan.CONTRAST) if arguments.known_levels else None
    document = common.describe_run(arguments.build, program=program, levels=levels, repetitions=arguments.repetitions)
    cases = [CASES[k] for k in arguments.cases]
    tasks = [
        (arguments.build, title, direction, repetition, levels, cases)
        for repetition in range(arguments.repetitions) for title in arguments.parts
        for direction in directions_of(title, arguments.directions)
    ]  # fmt: skip
    with multiprocessing.get_context("spawn").Pool(arguments.processes) as pool:

        def save(rows):
            tables.write(document | {"rows": rows}, arguments.output)

        document["rows"], _ = study.collect(pool, measure, tasks, list(DIRECTIONS), save)
        pool.close()
        pool.join()
    tables.write(document, arguments.output)
    print(tables.format_all(document))


if __name__ == "__main__":
    main()
