#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""An engine block from an industrial CT: a shell mesh with thickness, as a picture and as input of a solver.

Needs the program medialvoxel, and PyVista (scripts/mesh-readers makes an environment with it). The volume is the engine
block of scripts/demo, 256 x 256 x 110 voxels, headerless uint8 or with a header. Writes engine.vtp, engine.inp and
engine.png into the folder.
"""

import argparse
import pathlib
import subprocess

import numpy as np
import pyvista

from shell_model import ShellModel

LOWER = 72  # the smallest grey value of metal


def make_mesh(arguments, name):
    """A mesh in the format that the name asks for."""
    command = [arguments.program, "mesh", arguments.volume, arguments.folder / name, "--lower", str(LOWER)]
    command += ["--thickness", arguments.thickness, "--overwrite", "--quiet"]
    if arguments.volume.suffix not in (".mha", ".mhd", ".nrrd", ".nhdr"):
        command += ["--raw-size", "256,256,110", "--raw-type", "uint8"]
    subprocess.run(command, check=True)
    return arguments.folder / name


def draw(mesh, path):
    """The mesh in the colors of its thickness, without a screen; the scale leaves out the outer 2 percent."""
    known = mesh["Thickness"][np.isfinite(mesh["Thickness"])]
    plotter = pyvista.Plotter(off_screen=True, window_size=(1000, 640))
    plotter.set_background("white")
    plotter.add_mesh(
        mesh,
        scalars="Thickness",
        cmap="viridis",
        clim=[float(limit) for limit in np.percentile(known, (2, 98))],
        scalar_bar_args={"title": "Thickness (voxels)", "color": "black", "vertical": True},
    )
    plotter.camera_position = "xz"
    plotter.camera.azimuth = 35
    plotter.camera.elevation = 30
    plotter.camera.zoom(1.35)
    plotter.screenshot(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("volume", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--program", default="medialvoxel", help="the program medialvoxel")
    parser.add_argument("--thickness", default="auto", help="given to medialvoxel (%(default)s)")
    arguments = parser.parse_args()

    mesh = pyvista.read(make_mesh(arguments, "engine.vtp"))
    print(f"vertices   {mesh.n_points}\nfaces      {mesh.n_cells}")
    rims = np.count_nonzero(mesh["RimEdges"])
    print(f"of them    {rims} at rims, {np.count_nonzero(mesh['JunctionEdges'])} at junctions")
    print(f"area       {mesh['Area'].sum():.6g}")
    draw(mesh, arguments.folder / "engine.png")

    model = ShellModel(make_mesh(arguments, "engine.inp"))
    thicknesses = model.thicknesses()
    print(f"elements   {model.number_of_elements()} in {len(thicknesses)} sections")
    print(f"thickness  {thicknesses[0]:.3g} to {thicknesses[-1]:.3g}")


if __name__ == "__main__":
    main()
