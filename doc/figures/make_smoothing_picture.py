#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Draws a section through a noisy wall of 3 voxels with its medial cells, without and with smoothing.

Usage: doc/figures/make_smoothing_picture.py BUILD OUTPUT.png          needs numpy, scipy and matplotlib
"""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench"))

import matplotlib  # noqa: E402

matplotlib.use("Agg")

import matplotlib.pyplot as pyplot  # noqa: E402
import measure_smoothing  # noqa: E402
import numpy  # noqa: E402


def main():
    build, output = pathlib.Path(sys.argv[1]), sys.argv[2]
    part = measure_smoothing.wall(3, (1, 3, 4))
    values = measure_smoothing.scan(0.4)(measure_smoothing.occupy(part), numpy.random.default_rng(3))
    figure, grid = pyplot.subplots(1, 2, figsize=(9, 4.6), layout="constrained")
    with tempfile.TemporaryDirectory() as folder:
        runner = measure_smoothing.Runner(build, pathlib.Path(folder))
        for axes, smoothing in zip(grid, ("off", "auto")):
            medial, _, _ = runner.run(values, smoothing)
            middle = part.size // 2
            axes.imshow(values[:, :, middle], cmap="gray", vmin=-1, vmax=2, origin="lower", interpolation="nearest")
            z, y = numpy.nonzero(medial[:, :, middle])
            axes.plot(y + 0.5, z + 0.5, "s", color="red", markersize=2.6)
            axes.set_title(f"--smooth {smoothing}", family="monospace", fontsize=11)
            axes.set_axis_off()
    figure.savefig(output, dpi=100)


if __name__ == "__main__":
    main()
