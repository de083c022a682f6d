#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Renders the surface of a part twice, colored by the thickness of its walls and by rays; gray has neither (needs pyvista).

Usage: doc/figures/make_surface_picture.py SURFACE.vtp OUTPUT.png LARGEST    SURFACE is of medialvoxel surface --ray
LARGEST is the thickness of the last color.
"""

import sys

import pyvista
from PIL import Image

GRAY = "#c0c0c0"
COLUMNS = (("Thickness", "wall "), ("ray_thickness", "ray "))


def main():
    surface, output, largest = sys.argv[1:]
    mesh = pyvista.read(surface)
    plotter = pyvista.Plotter(off_screen=True, shape=(1, len(COLUMNS)), window_size=(1240, 620), border=False)
    for column, (name, title) in enumerate(COLUMNS):
        plotter.subplot(0, column)
        bar = {"title": title, "color": "black", "n_labels": 4, "position_y": 0.02}
        plotter.add_mesh(mesh.copy(), scalars=name, clim=(0, float(largest)), cmap="viridis", nan_color=GRAY, scalar_bar_args=bar)
        plotter.set_background("white")
        plotter.view_isometric()
        plotter.camera.azimuth = 20
        plotter.camera.zoom(0.95)
    Image.fromarray(plotter.screenshot(return_img=True)).quantize(256).save(output, optimize=True)


if __name__ == "__main__":
    main()
