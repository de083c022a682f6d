#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Renders a medial surface, colored by the thickness of the walls, and a part of it with its edges (needs pyvista).

Usage: doc/figures/make_mesh_picture.py MESH.vtp OUTPUT.png [--largest THICKNESS] [--turn DEGREES]
In the enlarged part black lines are where it ends, red ones junctions of sheets.
"""

import argparse
import collections
import pathlib

import numpy
import pyvista
from PIL import Image

RIM, JUNCTION = (20, 20, 20), (200, 30, 45)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--largest", type=float, help="thickness of the last color; default: that of 98 of 100 vertices")
    parser.add_argument("--turn", type=float, default=35.0, help="about the z axis")
    return parser.parse_args()


def sides_by_faces(mesh):
    """Vertices of the sides of one face, and of those of more than two."""
    count = collections.Counter()
    faces, position = mesh.faces, 0
    while position < len(faces):
        corners = faces[position + 1 : position + 1 + faces[position]]
        count.update(tuple(sorted(pair)) for pair in zip(corners, numpy.roll(corners, -1)))
        position += 1 + faces[position]
    return [side for side, n in count.items() if n == 1], [side for side, n in count.items() if n > 2]


def lines(mesh, sides):
    cells = numpy.hstack([[2, *side] for side in sides]) if sides else None
    return pyvista.PolyData(mesh.points, lines=cells) if sides else None


def enlarged_part(mesh):
    """A fifth of the surface around the vertex nearest to its middle."""
    middle = mesh.points[numpy.argmin(numpy.linalg.norm(mesh.points - mesh.points.mean(axis=0), axis=1))]
    reach = 0.1 * numpy.array(mesh.bounds[1::2] - numpy.array(mesh.bounds[::2])).max()
    near = numpy.linalg.norm(mesh.points - middle, axis=1) < reach
    return mesh.extract_points(near, adjacent_cells=False).extract_surface(algorithm=None)


def main():
    arguments = parse_arguments()
    mesh = pyvista.read(arguments.mesh)
    largest = arguments.largest or float(numpy.percentile(mesh.point_data["Thickness"], 98))
    color = {"scalars": "Thickness", "cmap": "viridis", "clim": (0, largest)}

    plotter = pyvista.Plotter(off_screen=True, shape=(1, 2), window_size=(1240, 560), border=False)
    plotter.set_background("white")
    plotter.add_mesh(mesh, show_scalar_bar=False, **color)
    plotter.view_isometric()
    plotter.camera.azimuth = arguments.turn
    plotter.camera.zoom(1.2)
    plotter.subplot(0, 1)
    part = enlarged_part(mesh)
    bar = {"title": "thickness of the wall\n", "color": "black", "n_labels": 4, "fmt": "%.0f"}
    plotter.add_mesh(part, show_edges=True, edge_color="gray", scalar_bar_args=bar, **color)
    for sides, line_color in zip(sides_by_faces(part), (RIM, JUNCTION)):
        if sides:
            plotter.add_mesh(lines(part, sides), color=line_color, line_width=4)
    plotter.view_isometric()
    plotter.camera.azimuth = arguments.turn
    plotter.camera.zoom(1.1)
    picture = Image.fromarray(plotter.screenshot(return_img=True))
    picture.quantize(256, Image.Quantize.MAXCOVERAGE).save(arguments.output, optimize=True)


if __name__ == "__main__":
    main()
