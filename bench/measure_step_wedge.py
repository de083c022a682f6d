#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""A step-wedge study: thickness of walls of 0.5 to 16 voxels in virtual scans, with all that the default of the program does.

Parts are step wedges and concentric tubes at five tilts, with exact partial volumes (virtual_parts.py). Scans have a
Gaussian blur of 0.5 to 1.5 voxels and white or correlated noise of 0 to 40 % of the contrast (virtual_scan.py). With
--tomography, wedges are also reconstructed from cone-beam projections (virtual_tomography.py). Each repetition has its
own noise and its own place between the voxels; the tilts take turns.

bias           mean error of all cells
tilt_bias      the same for each tilt, mean of its repetitions
repeatability  standard deviation of the mean of a wall over repetitions of one tilt
rms            of the errors of all cells
covered        lines through the middle, normal to it, with a medial cell within half a wall and one voxel, in percent
in_interval    cells whose 95 % interval holds the true thickness, in percent
edge           half-contrast crossings of single lines along the true normal: the best that a surface can do

Prints Markdown tables and writes one JSON file.
Usage: bench/measure_step_wedge.py BUILD [options]           needs numpy and scipy, itk-rtk for --tomography
"""

import argparse
import multiprocessing
import pathlib
import sys
import tempfile
import time

import numpy as np
import run_benchmarks as common
import thickness_runs as runs
import virtual_checks
import virtual_parts as parts
import virtual_scan as scan
import wedge_tables as tables

SEED = 20261123
WALLS = ((0.5, 1, 2, 4, 8), (0.75, 1.5, 3, 6, 16))
MAKERS = {"wedge": parts.step_wedge, "tubes": parts.cylinders}
BLURS = (0.5, 0.8, 1.0, 1.5)
# Kind of noise and its standard deviation in percent of the contrast.
NOISES = (("white", 0), *((kind, percent) for kind in ("white", "correlated") for percent in (5, 10, 20, 40)))
# Results are saved after this many parts, so that a stopped run is not lost; rows say how many volumes they are of.
SAVED = 2
QUICK_BLURS = (0.8,)
QUICK_NOISES = (("white", 0), ("white", 10), ("white", 20), ("correlated", 20))


def measure_scans(task):
    """All blurs and noises of one part at one place: (key of the row, tilt, sums)."""
    build, kind, group, repetition, blurs, noises = task
    tilt = list(parts.TILTS)[repetition % len(parts.TILTS)]
    random = np.random.default_rng([SEED, repetition, group, list(MAKERS).index(kind)])
    part = MAKERS[kind](WALLS[group], parts.TILTS[tilt], random.uniform(-0.5, 0.5, 3))
    rays, fine, result = runs.make_rays(part), part.fill(scan.DIVISION), []
    with tempfile.TemporaryDirectory() as folder:
        program = runs.Program(build, pathlib.Path(folder))
        for sigma in blurs:
            blurred = scan.blur(fine, sigma)
            for noise, percent in noises:
                values = blurred + scan.make_noise(blurred.shape, percent / 100, noise == "correlated", random)
                values = scan.digitize(values)
                found = runs.run_unless_refused(program, values)
                if found is None:
                    continue
                sums = runs.judge(part, rays, runs.to_unit(values), found)
                result += [((kind, sigma, noise, percent, wall.thickness), tilt, row) for wall, row in zip(part.walls, sums)]
    return result, []


def measure_tomography(task):
    # RTK is only needed here.
    import virtual_tomography

    build, group, tilt, count = task
    repetitions = range(list(parts.TILTS).index(tilt), count, len(parts.TILTS))
    return virtual_tomography.measure(build, WALLS[group], tilt, repetitions, (SEED, group))


def collect(pool, work, tasks, order, save=lambda rows: None):
    """Rows of figures, sorted by their keys, and descriptions of volumes; order: of the tilts; save: gets early rows."""
    groups, volumes = {}, []
    for number, (found, described) in enumerate(pool.imap_unordered(work, tasks, chunksize=1)):
        for key, tilt, row in found:
            groups.setdefault(key, []).append((tilt, row))
        volumes += described
        print(f"{number + 1} of {len(tasks)}", end="\r", file=sys.stderr)
        if (number + 1) % SAVED == 0:
            save(make_rows(groups, order))
    return make_rows(groups, order), sorted(volumes, key=str)


def make_rows(groups, order):
    rows = []
    for key in sorted(groups):
        entries = sorted(groups[key], key=lambda entry: order.index(entry[0]))
        names = ("part", "blur", "noise", "noise_percent", "wall")
        rows.append(dict(zip(names, key)) | runs.summarize([row for _, row in entries], [tilt for tilt, _ in entries]))
    return rows


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("--repetitions", type=int, default=20, help="default 20, four for each tilt")
    parser.add_argument("--quick", action="store_true", help="one blur, four noises")
    parser.add_argument("--blurs", nargs="+", type=float, default=BLURS, help="default 0.5 0.8 1 1.5")
    parser.add_argument("--noises", nargs="+", type=int, help=f"indices of {NOISES}; default: all")
    parser.add_argument("--tomography", choices=("also", "only"), help="from projections; needs itk-rtk")
    parser.add_argument("--program-commit", help="commit that the program is of; default: that of this script")
    parser.add_argument("--processes", type=int, default=2, help="default 2")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "step-wedge.json")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    blurs, noises = (QUICK_BLURS, QUICK_NOISES) if arguments.quick else (arguments.blurs, NOISES)
    noises = noises if arguments.noises is None else [NOISES[k] for k in arguments.noises]
    with tempfile.TemporaryDirectory() as folder:
        program = runs.Program(arguments.build, pathlib.Path(folder)).describe(arguments.program_commit)
    start = time.process_time() + sum(children_seconds())
    document = common.describe_run(arguments.build, program=program, repetitions=arguments.repetitions)
    document["checks"] = virtual_checks.run_checks()
    groups = range(len(WALLS))
    tasks = [
        (arguments.build, kind, group, repetition, blurs, noises)
        for repetition in range(arguments.repetitions) for kind in MAKERS for group in groups
        if arguments.tomography != "only"
    ]  # fmt: skip
    with multiprocessing.get_context("spawn").Pool(arguments.processes) as pool:

        def save(rows):
            tables.write(document | {"rows": rows}, arguments.output)

        document["rows"], _ = collect(pool, measure_scans, tasks, list(parts.TILTS), save)
        save(document["rows"])
        if arguments.tomography:
            tasks = [(arguments.build, group, tilt, arguments.repetitions) for group in groups for tilt in parts.TILTS]
            rows, document["reconstructed"] = collect(pool, measure_tomography, tasks, list(parts.TILTS))
            document["rows"] += rows
        pool.close()
        pool.join()
    document["cpu_seconds"] = round(time.process_time() + sum(children_seconds()) - start)
    tables.write(document, arguments.output)
    print(tables.format_all(document))


def children_seconds():
    import resource

    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime, usage.ru_stime


if __name__ == "__main__":
    main()
