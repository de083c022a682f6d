#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Draws the thickness of two thin walls in a noisy scan, measured on the object, by crossings and by fits.

A thick wall below, which is not shown, tells the levels and the blur. Crossings are what the program measures without it.

Usage: bench/draw_thin_walls.py BUILD [OUTPUT.png]          needs numpy, scipy and matplotlib
"""

import pathlib
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import numpy as np  # noqa: E402
import thickness_runs as runs  # noqa: E402
import virtual_parts as parts  # noqa: E402
import virtual_scan as scan  # noqa: E402
from matplotlib import pyplot  # noqa: E402

OUTPUT = pathlib.Path(__file__).resolve().parents[1] / "doc" / "figures" / "thin-walls.png"
THICK, WALLS = 8, (2, 3)
SIZE, FIRST = 72, 28  # edge of the volume, and the first slice that is shown
BLUR, NOISE = 1.0, 0.2
SMALLEST, LARGEST = 1, 4
MEASURES = {"on the object": "--sub-voxel=off", "crossings of the threshold": "--sub-voxel", "fits of blurred walls": None}


def make_part():
    layers = [(-22.0, THICK), (0.0, WALLS[0]), (14.0, WALLS[1])]
    return parts.plates(layers, (1, 2, 5), (0.2, 0.1, -0.3), size=SIZE, half=24.0)


def measure(program, values, name):
    """Centers of the cells that are shown, and their thickness."""
    first = FIRST if name.startswith("crossings") else 0
    centers, thickness, _ = program.run(np.ascontiguousarray(values[first:]), measure=MEASURES[name])
    return centers + (0, 0, first), thickness


def describe(part, centers, thickness):
    """Mean and standard deviation of each wall, away from rims."""
    words = []
    for wall in part.walls[1:]:
        here = (np.abs(wall.offset(centers)) < runs.FAR) & wall.is_clear(centers, part.size) & (thickness > 0)
        words.append(f"{thickness[here].mean():.2f} ± {thickness[here].std():.2f}")
    return ", ".join(words)


def main():
    build, output = pathlib.Path(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else OUTPUT
    part = make_part()
    random = np.random.default_rng(11)
    values = scan.blur(part.fill(scan.DIVISION), BLUR)
    values = scan.digitize(values + scan.make_noise(values.shape, NOISE, False, random))
    middle = SIZE // 2
    figure, grid = pyplot.subplots(1, 3, figsize=(10.5, 2.7), layout="constrained")
    with tempfile.TemporaryDirectory() as folder:
        program = runs.Program(build, pathlib.Path(folder))
        for axes, name in zip(grid, MEASURES):
            centers, thickness = measure(program, values, name)
            axes.imshow(runs.to_unit(values[:, middle]), cmap="gray", vmin=-0.7, vmax=1.7, origin="lower", interpolation="nearest")
            here = (np.floor(centers[:, 1]) == middle) & (thickness > 0)
            x, z = centers[here, 0], centers[here, 2]
            drawn = axes.scatter(x, z, c=thickness[here], s=9, marker="s", linewidths=0, cmap="plasma", vmin=SMALLEST, vmax=LARGEST)
            axes.set_ylim(FIRST, SIZE - 10)
            axes.set_title(f"{name}\n{describe(part, centers, thickness)}", fontsize=10)
            axes.set_axis_off()
    figure.colorbar(drawn, ax=grid[-1], fraction=0.04).set_label("thickness, voxels")
    figure.savefig(output, dpi=100)


if __name__ == "__main__":
    main()
