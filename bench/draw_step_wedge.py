#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Draws the results of measure_step_wedge.py: error of the thickness over the wall, and how many intervals hold the truth.

Usage: bench/draw_step_wedge.py [results/step-wedge.json] [--folder doc/figures]     needs matplotlib
       writes step-wedge.png, and step-wedge-intervals.png where the result has intervals
"""

import argparse
import json
import pathlib

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot, ticker  # noqa: E402
from wedge_tables import is_found, noise_name, select  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[1]
COLORS = {0: "#4d4d4d", 5: "#3a86c8", 10: "#2a9d8f", 20: "#e9a03b", 40: "#c1121f"}
PART = "wedge"


def draw_errors(axes, rows, percent, noise):
    """Mean error, and as bars the standard deviation of single cells; walls found by less than a half are left out."""
    rows = sorted((row for row in rows if is_found(row) and row["cells"]), key=lambda row: row["wall"])
    spread = [max(row["rms"] ** 2 - row["bias"] ** 2, 0) ** 0.5 for row in rows]
    # Curves of different noise lie beside each other.
    places = [row["wall"] * (1 + 0.035 * (list(COLORS).index(percent) - 2)) for row in rows]
    axes.errorbar(places, [row["bias"] for row in rows], spread, fmt="o-", color=COLORS[percent], markersize=3.5,
                  linewidth=1, elinewidth=0.8, capsize=2, label=noise_name(noise, percent))  # fmt: skip


def draw_intervals(axes, rows, percent, noise):
    rows = [row for row in rows if is_found(row) and row["in_interval_percent"] is not None]
    rows.sort(key=lambda row: row["wall"])
    axes.plot([row["wall"] for row in rows], [row["in_interval_percent"] for row in rows], "o-", color=COLORS[percent],
              markersize=3.5, linewidth=1, label=noise_name(noise, percent))  # fmt: skip


def draw(rows, draw_one, title, limits, truth, path):
    rows = select(rows, part=PART)
    blurs = sorted({row["blur"] for row in rows})
    figure, grid = pyplot.subplots(2, len(blurs), figsize=(3.1 * len(blurs), 6), sharex=True, sharey=True, squeeze=False,
                                   layout="constrained")  # fmt: skip
    for line, noise in zip(grid, ("white", "correlated")):
        for axes, blur in zip(line, blurs):
            for percent in COLORS:
                found = select(rows, blur=blur, noise="white" if percent == 0 else noise, noise_percent=percent)
                draw_one(axes, found, percent, noise)
            axes.axhline(truth, color="black", linewidth=0.6)
            axes.set_xscale("log", base=2)
            axes.set_xlim(0.4, 20)
            axes.set_ylim(*limits)
            axes.xaxis.set_major_locator(ticker.FixedLocator([0.5, 1, 2, 4, 8, 16]))
            axes.xaxis.set_major_formatter(ticker.FormatStrFormatter("%g"))
            axes.grid(alpha=0.3)
            axes.set_title(f"blur {blur:g}, {noise} noise", fontsize=9)
        line[0].set_ylabel(title)
        line[0].legend(fontsize=7, loc="upper left")
    for axes in grid[-1]:
        axes.set_xlabel("wall, voxels")
    figure.savefig(path, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", type=pathlib.Path, nargs="?", default=ROOT / "bench" / "results" / "step-wedge.json")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "doc" / "figures")
    arguments = parser.parse_args()
    rows = json.loads(arguments.file.read_text(encoding="utf-8"))["rows"]
    draw(rows, draw_errors, "error, voxels", (-2.1, 1.1), 0, arguments.folder / "step-wedge.png")
    if any(row["in_interval_percent"] is not None for row in rows):
        draw(rows, draw_intervals, "cells in their interval, %", (50, 101), 95, arguments.folder / "step-wedge-intervals.png")


if __name__ == "__main__":
    main()
