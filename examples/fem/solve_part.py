#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""A part from an industrial CT, from scan to result: a shell mesh, its quality, material, supports and loads, and a picture.

Nodes at the bottom (least z) are held, those at the top carry a force downwards. Needs the program medialvoxel, CalculiX (Debian
package calculix-ccx), and for the picture PyVista (scripts/mesh-readers makes an environment with it).
"""

import argparse
import json
import pathlib
import subprocess
import tempfile
import time

import numpy

from shell_model import ShellModel, find_loose, solve_all

LAYER = 5.0  # of nodes that are held or loaded, in mm


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("volume", type=pathlib.Path)
    parser.add_argument("picture", type=pathlib.Path, nargs="?", help="PNG; none: only numbers")
    parser.add_argument("--lower", required=True, help="smallest value of the material")
    parser.add_argument("--program", default="medialvoxel", help="the program medialvoxel")
    parser.add_argument("--modulus", type=float, default=70000.0, help="in N/mm^2 (%(default)s)")
    parser.add_argument("--poisson-ratio", type=float, default=0.33, help="(%(default)s)")
    parser.add_argument("--force", type=float, default=10000.0, help="in N (%(default)s)")
    return parser.parse_args()


def make_mesh(arguments, folder):
    """The mesh of the part, whose quality keeps the limits."""
    path, report = folder / "part.inp", folder / "report.json"
    command = [arguments.program, "mesh", arguments.volume, path, "--lower", arguments.lower, "--report", report]
    subprocess.run([*command, "--quiet"], check=True)
    for limit in json.loads(report.read_text(encoding="utf-8"))["mesh"]["quality"]["limits"]:
        print(f"{limit['name']}: {limit['value']}")
        if not limit["holds"]:
            raise SystemExit(f"the mesh is beyond a limit: {limit}")
    return ShellModel(path)


def press(model, arguments, folder):
    """Displacements of the nodes, and stresses of the elements."""
    heights = {node: place[2] for node, place in model.nodes.items()}
    bottom = min(heights.values())
    held = [node for node, height in heights.items() if height < bottom + LAYER]
    # Other pieces stay where they are.
    loose = set(find_loose(model, held))
    top = max(height for node, height in heights.items() if node not in loose)
    loaded = [node for node, height in heights.items() if height > top - LAYER and node not in loose]
    forces = {node: (0.0, 0.0, -arguments.force / len(loaded)) for node in loaded}
    return solve_all(model, (arguments.modulus, arguments.poisson_ratio), [*held, *loose], forces, folder)


def draw(model, moved, stresses, path):
    """The deformed part, in the colors of displacement and stress; the scale leaves out the largest 2 percent."""
    import pyvista  # only for the picture
    from PIL import Image

    index = {node: i for i, node in enumerate(model.nodes)}
    faces = [[len(nodes), *(index[node] for node in nodes)] for nodes in model.elements()]
    places = numpy.array(list(model.nodes.values()))
    ways = numpy.array([moved[node] for node in model.nodes])
    scale = 0.05 * numpy.ptp(places, axis=0).max() / numpy.linalg.norm(ways, axis=1).max()
    mesh = pyvista.PolyData(places + scale * ways, numpy.concatenate(faces))
    displacement = f"Displacement in mm, drawn {scale:.0f} times"
    mesh[displacement] = numpy.linalg.norm(ways, axis=1)
    mesh["von Mises stress in N/mm2"] = numpy.array([stresses[number] for number, _ in model.numbered_elements()])
    plotter = pyvista.Plotter(off_screen=True, shape=(1, 2), border=False, window_size=(1240, 600))
    for column, name in enumerate((displacement, "von Mises stress in N/mm2")):
        plotter.subplot(0, column)
        plotter.set_background("white")
        bar = {"title": name, "color": "black", "fmt": "%.2g", "n_labels": 4, "title_font_size": 17, "label_font_size": 15}
        bar |= {"position_x": 0.15, "position_y": 0.01, "width": 0.7, "height": 0.09}
        limits = [0.0, float(numpy.percentile(mesh[name], 98))]
        plotter.add_mesh(
            mesh.copy(), scalars=name, cmap="turbo", clim=limits, scalar_bar_args=bar, show_edges=True, line_width=0.5
        )
        plotter.camera_position = "xz"
        plotter.camera.azimuth = 35
        plotter.camera.elevation = 30
        plotter.reset_camera()
    Image.fromarray(plotter.screenshot()).quantize(256, method=Image.Quantize.FASTOCTREE).save(path, optimize=True)


def main():
    arguments = parse_arguments()
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        start = time.monotonic()
        model = make_mesh(arguments, folder)
        meshed = time.monotonic()
        moved, stresses = press(model, arguments, folder)
        solved = time.monotonic()
    largest = max(numpy.linalg.norm(way) for way in moved.values())
    print(f"elements        {model.number_of_elements()}")
    print(f"displacement    {largest:.4g} mm at most")
    print(f"stress          {numpy.percentile(list(stresses.values()), 98):.4g} N/mm^2 in 98 % of the elements at most")
    print(f"time            mesh {meshed - start:.1f} s, solver {solved - meshed:.1f} s")
    if arguments.picture:
        draw(model, moved, stresses, arguments.picture)


if __name__ == "__main__":
    main()
