#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Draws a section through a plate with steps and its medial cells, for three thicknesses, without and with noise.

Usage: doc/figures/make_thickness_picture.py BUILD OUTPUT.png          needs numpy, scipy and matplotlib
"""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench"))

import compare_sheets  # noqa: E402
import draw_sheets  # noqa: E402
import numpy  # noqa: E402
import sheet_parts  # noqa: E402

WALLS = (2, 3, 4, 6, 10, 16)
WIDTH = 18
CHOICES = {"automatic": "auto", "fixed 3": "3", "fixed 5": "5"}
NOISES = {"clean": None, "a tenth of the voxels next to the surface flipped": sheet_parts.flips}


def steps():
    """One plate with all walls in a row; a margin of a few voxels around it."""
    begin = -WIDTH * len(WALLS) / 2
    # Off the middle between voxels, so that walls of odd thickness have it.
    boxes = [((begin + (k + 0.5) * WIDTH, 0, 0.25), (WIDTH / 2, 22, wall / 2)) for k, wall in enumerate(WALLS)]
    return sheet_parts.Plates(116, boxes, numpy.eye(3))


def main():
    build, output = pathlib.Path(sys.argv[1]), sys.argv[2]
    # The section is across the length, in the middle of the width: an image of x and z.
    mask = sheet_parts.clean(steps())
    titles = {name: name for name in NOISES}
    figure, grid = draw_sheets.make_axes(len(CHOICES), titles, (10, 3))
    with tempfile.TemporaryDirectory() as folder:
        runner = compare_sheets.Runner(build, pathlib.Path(folder), 1)
        volume = pathlib.Path(folder) / "volume.raw"
        for column, noise in enumerate(NOISES.values()):
            noisy = noise(mask) if noise else mask
            noisy.tofile(volume)
            for row, (label, thickness) in zip(grid, CHOICES.items()):
                cells = runner.extract(volume, mask.shape[::-1], thickness)[0]
                middle = mask.shape[1] // 2
                draw_sheets.draw_slice(row[column], noisy[:, middle], cells[:, middle], 0.5, 2.5)
                grid[list(CHOICES).index(label)][0].set_ylabel(label, fontsize=10)
    figure.savefig(output, dpi=110)


if __name__ == "__main__":
    main()
