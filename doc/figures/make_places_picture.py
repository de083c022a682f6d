#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Draws the first thin places of a part: on its sheet, and each in a section through its thinnest cell.

The sections show the voxels of the object, the medial cells of the place, and the boundary voxels on both sides of the
thinnest cell. A section is across the axis along which these two differ least.

Usage: doc/figures/make_places_picture.py BUILD VOLUME.mha LOWER OUTPUT.png [LIMIT]    needs numpy, scipy, matplotlib
VOLUME is uncompressed bytes or zlib-packed. LIMIT is that of thin places in voxels, 4 when it is not given.
"""

import pathlib
import subprocess
import sys
import tempfile

import matplotlib
import numpy

matplotlib.use("Agg")
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "apps" / "test"))

import make_picture  # noqa: E402
from matplotlib import pyplot  # noqa: E402
from matplotlib.colors import ListedColormap  # noqa: E402
from PIL import Image  # noqa: E402
from places import read_places  # noqa: E402
from scipy import ndimage  # noqa: E402

COLORS = ((213, 40, 40), (20, 110, 190), (230, 140, 0), (20, 150, 90), (150, 60, 170))
SHEET = (205, 210, 216)
TURN, TILT = 35.0, 40.0
REACH = 22  # voxels from the thinnest cell to the edges of a section
AXES = "zyx"
LEGEND = "gray: object\ncolor: medial cells of the place\n+: boundary voxels on both\n   sides of the thinnest cell\nlengths in voxels"


def find_places(build, volume, lower, limit):
    """Rows of the table, and the thickness map."""
    program = build / "apps" / "medialvoxel" / "medialvoxel"
    with tempfile.TemporaryDirectory() as folder:
        table, thickness = (pathlib.Path(folder) / name for name in ("places.csv", "map.mha"))
        command = [program, "extract", volume, pathlib.Path(folder) / "labels.mha", "--lower", lower]
        command += ["--thin-below", limit, "--places", table, "--thickness-map", thickness, "--quiet"]
        subprocess.run([str(word) for word in command], check=True)
        return read_places(table)[: len(COLORS)], make_picture.read_meta_image(thickness)


def number_cells(rows, thickness, limit):
    """Numbers of the places at their cells, 0 elsewhere."""
    grown = (thickness > 0) & (thickness < 1.125 * limit)
    parts = ndimage.label(grown, numpy.ones((3, 3, 3)))[0]
    numbers = numpy.zeros(thickness.shape, int)
    for row in rows:
        numbers[parts == parts[tuple(row[f"index_{axis}"] for axis in AXES)]] = row["place"]
    return numbers


def draw_sheet(axes, thickness, numbers, rows):
    """Places that the sheet hides shine through."""
    cells = numpy.argwhere(thickness != 0)
    view = (thickness.shape, TURN, TILT)
    frame = make_picture.frame_of(*make_picture.project(cells, *view)[:2])
    colors = numpy.array((SHEET, *COLORS), float)[numbers[tuple(cells.T)]]
    sheet = make_picture.render(cells + 0.5, colors, view, frame).astype(float)
    scale, shift_u, shift_v = frame
    for row, color in zip(rows, COLORS):
        members = numpy.argwhere(numbers == row["place"]) + 0.5
        here = make_picture.render(members, numpy.tile(numpy.array(color, float), (len(members), 1)), view, frame)
        seen = (here != make_picture.PAPER).any(axis=2)
        sheet[seen] = 0.55 * sheet[seen] + 0.45 * numpy.array(color)
        point = numpy.array([[row[f"index_{axis}"] + 0.5 for axis in AXES]])
        u, v, _ = make_picture.project(point, *view)
        at = u[0] * scale + shift_u, v[0] * scale + shift_v
        axes.annotate(
            str(row["place"]), at, (18, 18), textcoords="offset points", fontsize=12, weight="bold",
            arrowprops={"arrowstyle": "-"}, bbox={"boxstyle": "circle,pad=0.15", "facecolor": "white"},
        )  # fmt: skip
    axes.imshow(sheet.astype(numpy.uint8))
    axes.set_title("first places on the sheet", fontsize=10)
    axes.set_axis_off()


def draw_section(axes, inside, numbers, row):
    sides = numpy.array([[row[f"side_{side}_{axis}"] for axis in AXES] for side in "ab"])
    across = int(numpy.argmin(numpy.abs(sides[1] - sides[0])))
    down, right = (axis for axis in range(3) if axis != across)
    index = [row[f"index_{axis}"] for axis in AXES]
    axes.imshow(inside.take(index[across], across), cmap=ListedColormap(["white", "#b4c0cd"]), vmin=0, vmax=1)
    here = numpy.argwhere(numbers.take(index[across], across) == row["place"])
    color = numpy.array(COLORS[row["place"] - 1]) / 255
    axes.scatter(here[:, 1] + 0.5, here[:, 0] + 0.5, s=9, color=color)
    axes.plot(sides[:, right], sides[:, down], "k+-", markersize=8, markeredgewidth=1.5, linewidth=1)
    axes.set_xlim(index[right] - REACH, index[right] + REACH)
    axes.set_ylim(index[down] + REACH, index[down] - REACH)
    axes.set_xticks([])
    axes.set_yticks([])
    axes.set_xlabel(f"{AXES[right]}, down {AXES[down]}; {AXES[across]} = {index[across]}", fontsize=8)
    axes.set_title(f"{row['place']}: minimum {row['minimum']:.2f}, area {row['area']:.0f}", fontsize=9)


def main():
    build, volume, lower, output = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), float(sys.argv[3]), sys.argv[4]
    limit = float(sys.argv[5]) if len(sys.argv) > 5 else 4.0
    rows, thickness = find_places(build, volume, lower, limit)
    inside = make_picture.read_meta_image(volume) >= lower
    numbers = number_cells(rows, thickness, limit)
    figure = pyplot.figure(figsize=(12.4, 5.4), dpi=100, layout="constrained")
    grid = figure.add_gridspec(2, 5)
    draw_sheet(figure.add_subplot(grid[:, :2]), thickness, numbers, rows)
    for number, row in enumerate(rows):
        draw_section(figure.add_subplot(grid[number // 3, 2 + number % 3]), inside, numbers, row)
    legend = figure.add_subplot(grid[1, 4])
    legend.text(0, 0.5, LEGEND, va="center", fontsize=9)
    legend.set_axis_off()
    figure.canvas.draw()
    picture = Image.fromarray(numpy.asarray(figure.canvas.buffer_rgba())[:, :, :3])
    picture.quantize(256, Image.Quantize.MAXCOVERAGE).save(output, optimize=True)


if __name__ == "__main__":
    main()
