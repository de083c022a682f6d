#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Renders shell meshes of joints, a bend and a plate with holes, of parts in gray volumes (needs numpy, scipy and PyVista).

Usage: doc/figures/make_joints_picture.py OUTPUT.png [--program medialvoxel] [--extend-rims]
Black lines are sides of elements, red ones junctions.
"""

import argparse
import collections
import pathlib
import sys
import tempfile

import numpy
import pyvista
from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "bench"), str(ROOT / "examples/fem")]

from solve_shells import JOINTS, Mesher  # noqa: E402

NAMES = ("2 on 4", "8 on 4", "bend of 4, radius 0", "plate of 4, holes")
TILT = "15 degrees"


def to_surface(model, part):
    """On the axes of the part, and the sides of more than two elements as lines."""
    index = {node: i for i, node in enumerate(model.nodes)}
    faces = [[index[node] for node in nodes] for nodes in model.elements()]
    places = part.to_part(numpy.array(list(model.nodes.values())))
    sides = collections.Counter(tuple(sorted(side)) for face in faces for side in zip(face, face[1:] + face[:1]))
    lines = [(2, *side) for side, count in sides.items() if count > 2]
    surface = pyvista.PolyData(places, numpy.concatenate([[len(face), *face] for face in faces]))
    return surface, pyvista.PolyData(places, lines=numpy.concatenate(lines)) if lines else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--program", default="medialvoxel", help="the program medialvoxel")
    parser.add_argument("--extend-rims", action="store_true", help="passed on to the program")
    arguments = parser.parse_args()
    plotter = pyvista.Plotter(off_screen=True, shape=(1, len(NAMES)), window_size=(1400, 380), border=False)
    with tempfile.TemporaryDirectory() as temporary:
        mesher = Mesher(arguments.program, ["--extend-rims" if arguments.extend_rims else "--extend-rims=off"], pathlib.Path(temporary))
        for column, name in enumerate(NAMES):
            part = JOINTS[name](TILT)
            surface, junctions = to_surface(mesher.mesh_part(part, True), part)
            plotter.subplot(0, column)
            plotter.set_background("white")
            plotter.add_mesh(surface, color="#c9d3dc", show_edges=True, line_width=1)
            if junctions is not None:
                plotter.add_mesh(junctions, color=(200, 30, 45), line_width=6, render_lines_as_tubes=True)
            plotter.add_text(name, position="upper_edge", color="black", font_size=9)
            plotter.camera_position = [(1.2, 1.6, 0.9), (0, 0, 0), (0, 0, 1)]
            plotter.reset_camera()
            plotter.camera.zoom(1.2)
    Image.fromarray(plotter.screenshot()).quantize(64).save(arguments.output, optimize=True)


if __name__ == "__main__":
    main()
