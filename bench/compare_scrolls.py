#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Compares the sheet of the program in a rolled sheet with what readers of scrolls use: skeletons of scikit-image.

three axes  the 2-D skeletons of all slices along z, y and x, put together
3-D         the 3-D skeleton, which thins to curves

Kept, spurious, thickness and CPU seconds are those of compare_sheets.py. Both peers get the volume as it is; the program
does too, and once more with its defaults, which smooth noise and leave specks and pores out. Prints a Markdown table and
writes one JSON file; --picture also draws a slice of each.

Usage: bench/compare_scrolls.py BUILD [options]      needs numpy, scipy and scikit-image, for --picture matplotlib
"""

import argparse
import json
import pathlib
import sys
import tempfile

import compare_sheets
import numpy as np
import run_benchmarks as common
import sheet_parts
from scroll_part import Scroll

TITLES = {
    "extract": "MedialVoxel",
    "defaults": "MedialVoxel, defaults",
    "three-axes": "2-D skeletons, three axes",
    "skimage": "3-D skeleton",
}
SIZE, WALL, PITCH, WINDINGS, HALF = 160, 4, 10, (1, 5), 40
# Axes of the scroll, one per row, and the volumes by title with their noise.
SCROLLS = (
    (np.eye(3), {"scroll along z": None}),
    (sheet_parts.TURN, {"scroll, turned": None, "scroll, flips": sheet_parts.flips, "scroll, scan": sheet_parts.scan}),
)
DRAWN = ("scroll, turned", "scroll, scan")


class Runner(compare_sheets.Runner):
    """Knows the program's defaults too."""

    def _run_once(self, name, volume, size):
        if name == "defaults":
            return (*self.extract(volume, size, "auto", "auto", max_pore_size=32), None)
        return super()._run_once(name, volume, size)


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False
    )
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("--rounds", type=int, default=3, help="default 3")
    parser.add_argument("--picture", type=pathlib.Path, metavar="FILE", help="draw into it; needs matplotlib")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "scrolls.json")
    return parser.parse_args()


def measure(runner, title, mask, part):
    """Results and maps by name of the program."""
    size, volume = mask.shape[::-1], runner.scratch / "volume.raw"
    mask.tofile(volume)
    document, maps = {"part": title, "size": size, "object_voxels": int(np.count_nonzero(mask)), "results": {}}, {}
    for name in TITLES:
        maps[name], seconds, version = runner.run(name, volume, size)
        result = {"cells": int(np.isfinite(maps[name]).sum()), "cpu_seconds": round(seconds, 3), "version": version}
        shift = 0.0 if version else 0.5  # the program's cells lie between voxels
        document["results"][name] = result | compare_sheets.judge(part, maps[name], shift)
        print(f"{title}: {name}: {document['results'][name]}", file=sys.stderr)
    return document, maps


def format_rows(document):
    rows = ["| volume | method | cells | kept, % | spurious, % | thickness error | CPU s |", "|" + " --- |" * 7]
    for volume in document["volumes"]:
        for name, result in volume["results"].items():
            mean, deviation = result["thickness_mean_error"], result["thickness_deviation"]
            error = "-" if mean is None else f"{mean:+.2f} ± {deviation:.2f}"
            words = [volume["part"], TITLES[name], f"{result['cells']}", f"{result['kept_percent']:.1f}"]
            words += [f"{result['spurious_percent']:.2f}", error, f"{result['cpu_seconds']:.2f}"]
            rows.append("| " + " | ".join(words) + " |")
    return "\n".join(rows)


def draw(masks, maps, path):
    """The middle slice of each result."""
    import draw_sheets

    figure, grid = draw_sheets.make_axes(len(DRAWN), TITLES, (12, 3.1 * len(DRAWN)))
    for row, title in zip(grid, DRAWN):
        z = len(masks[title]) // 2
        row[0].set_ylabel(title, fontsize=11)
        for axes, name in zip(row, TITLES):
            shift = 0.5 if name in ("extract", "defaults") else 0
            draw_sheets.draw_slice(axes, masks[title][z], maps[title][name][z], shift, 2)
            axes.set_xlim(grid[0][0].get_xlim())
            axes.set_ylim(grid[0][0].get_ylim())
    figure.savefig(path, dpi=100)


def main():
    arguments = parse_arguments()
    details = {"wall": WALL, "pitch": PITCH, "windings": WINDINGS, "half_height": HALF}
    document = common.describe_run(arguments.build, rounds=arguments.rounds, scroll=details, volumes=[])
    masks, maps = {}, {}
    with tempfile.TemporaryDirectory() as name:
        runner = Runner(arguments.build, pathlib.Path(name), arguments.rounds)
        for turn, volumes in SCROLLS:
            part = Scroll(SIZE, WALL, PITCH, WINDINGS, HALF, turn)
            mask = sheet_parts.clean(part)
            for title, noise in volumes.items():
                masks[title] = noise(mask) if noise else mask
                results, maps[title] = measure(runner, title, masks[title], part)
                document["volumes"].append(results)
    arguments.output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print(format_rows(document))
    if arguments.picture:
        draw(masks, maps, arguments.picture)


if __name__ == "__main__":
    main()
