# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of what compare_sheets.py measured: one slice of each result, and the engine block from above."""

import matplotlib
import numpy

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

# Title of the part: the slice, as a share of the height.
SLICES = {"T of 4": 0.5, "ribs of 2 to 8": 0.5, "ribs, scan": 0.5}
ENGINE = "engine block"
ENGINE_SLICE = 0.5
MEDIAL = "#c1121f"
COLORS = matplotlib.colors.ListedColormap(["#ffffff", "#c9d3dc"])


def crop(mask):
    """First and last row and column with object, one below the other, with a margin."""
    rows, columns = (numpy.flatnonzero(mask.any(axis=axis)) for axis in (1, 0))
    return [(max(0, line[0] - 3), line[-1] + 4) for line in (rows, columns)]


def draw_slice(axes, mask, thickness, shift, marker):
    """Object gray, cells red; centers of cells are half a voxel from those of voxels."""
    axes.imshow(mask, cmap=COLORS, vmin=0, vmax=1, origin="lower", interpolation="nearest")
    y, x = numpy.nonzero(numpy.isfinite(thickness))
    axes.scatter(x + shift, y + shift, s=marker, c=MEDIAL, marker="s", linewidths=0)
    (bottom, top), (left, right) = crop(mask)
    axes.set_xlim(left - 0.5, right - 0.5)
    axes.set_ylim(bottom - 0.5, top - 0.5)


def make_axes(rows, titles, size):
    figure, grid = pyplot.subplots(rows, len(titles), figsize=size, squeeze=False, layout="constrained")
    for axes in grid.flat:
        axes.set_xticks([])
        axes.set_yticks([])
        for side in axes.spines.values():
            side.set_visible(False)
    for axes, title in zip(grid[0], titles.values()):
        axes.set_title(title, fontsize=11)
    return figure, grid


def draw_parts(masks, maps, titles, path):
    figure, grid = make_axes(len(SLICES), titles, (9, 3 * len(SLICES)))
    for row, (part, height) in zip(grid, SLICES.items()):
        z = int(height * len(masks[part]))
        row[0].set_ylabel(part, fontsize=11)
        for axes, name in zip(row, titles):
            draw_slice(axes, masks[part][z], maps[part][name][z], 0.5 if name == "extract" else 0, 5)
    figure.savefig(path, dpi=100)


def draw_engine(mask, maps, titles, path):
    """A slice, and below it the largest thickness along each vertical line."""
    figure, grid = make_axes(2, titles, (9, 5.6))
    z = int(ENGINE_SLICE * len(mask))
    for column, name in enumerate(titles):
        draw_slice(grid[0][column], mask[z], maps[name][z], 0.5 if name == "extract" else 0, 1.2)
        known = numpy.where(numpy.isfinite(maps[name]), maps[name], -1).max(axis=0)
        (bottom, top), (left, right) = crop(mask.any(axis=0))
        shown = numpy.ma.masked_less(known, 0)[bottom:top, left:right]
        image = grid[1][column].imshow(shown, cmap="viridis", vmin=0, vmax=24, origin="lower", interpolation="nearest")
    bar = figure.colorbar(image, ax=grid[:, -1], fraction=0.05, pad=0.02)
    bar.set_label("thickness, voxels")
    figure.savefig(path, dpi=100)


def draw_all(masks, maps, titles, folder):
    draw_parts(masks, maps, titles, folder / "comparison-parts.png")
    if ENGINE in masks:
        draw_engine(masks[ENGINE], maps[ENGINE], titles, folder / "comparison-engine.png")
