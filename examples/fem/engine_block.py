#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""An engine block from an industrial CT: a shell mesh with thickness, as a picture and as input of a solver.

Needs the program medialvoxel, meshio and PyVista (scripts/mesh-readers makes an environment with both). The volume is
the engine block of scripts/demo, 256 x 256 x 110 voxels, headerless uint8 or with a header. Writes engine.vtp, engine.inp and
engine.png into the folder.
"""

import argparse
import pathlib
import subprocess

import meshio
import numpy as np
import pyvista
from PIL import Image

from shell_model import ShellModel

LOWER = 72  # the smallest grey value of metal


def make_mesh(arguments, name):
    """A mesh in the format that the name asks for."""
    command = [arguments.program, "mesh", arguments.volume, arguments.folder / name, "--lower", str(LOWER)]
    command += ["--thickness", arguments.thickness, "--voxel-units", "--overwrite", "--quiet"]
    if arguments.volume.suffix not in (".mha", ".mhd", ".nrrd", ".nhdr"):
        command += ["--raw-size", "256,256,110", "--raw-type", "uint8"]
    subprocess.run(command, check=True)
    return arguments.folder / name


def read_sections(path):
    """The file for the solver as another library reads it, with the thickness of the section of each element."""
    mesh = meshio.read(path)
    thickness = [np.full(len(block.data), np.nan) for block in mesh.cells]
    for name, value in ShellModel(path).sections().items():
        for target, members in zip(thickness, mesh.cell_sets[name]):
            target[members] = value
    return pyvista.from_meshio(meshio.Mesh(mesh.points, mesh.cells, cell_data={"Section thickness": thickness}))


def draw(meshes, path):
    """Meshes side by side in the colors of a quantity, without a screen; the scale leaves out the outer 2 percent."""
    plotter = pyvista.Plotter(off_screen=True, shape=(1, len(meshes)), border=False, window_size=(1040, 520))
    for column, (name, mesh) in enumerate(meshes.items()):
        plotter.subplot(0, column)
        plotter.set_background("white")
        values = mesh[name]
        limits = [float(limit) for limit in np.percentile(values[np.isfinite(values)], (2, 98))]
        bar = {"title": name, "color": "black", "fmt": "%.1f", "n_labels": 3, "title_font_size": 16, "label_font_size": 14}
        bar |= {"position_x": 0.3, "position_y": 0.01, "width": 0.4, "height": 0.1}
        plotter.add_mesh(mesh, scalars=name, cmap="viridis", clim=limits, scalar_bar_args=bar)
        plotter.camera_position = "xz"
        plotter.camera.azimuth = 35
        plotter.camera.elevation = 30
        plotter.reset_camera()
        # Room for the scale.
        plotter.camera.zoom(0.92)
    Image.fromarray(plotter.screenshot()).quantize(256, method=Image.Quantize.FASTOCTREE).save(path, optimize=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("volume", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--program", default="medialvoxel", help="the program medialvoxel")
    parser.add_argument("--thickness", default="auto", help="of the walls, in voxels (%(default)s)")
    arguments = parser.parse_args()

    mesh = pyvista.read(make_mesh(arguments, "engine.vtp"))
    print(f"vertices   {mesh.n_points}\nfaces      {mesh.n_cells}")
    rims = np.count_nonzero(mesh["RimEdges"])
    print(f"of them    {rims} at rims, {np.count_nonzero(mesh['JunctionEdges'])} at junctions")
    print(f"area       {mesh['Area'].sum():.6g}")

    shells = read_sections(make_mesh(arguments, "engine.inp"))
    thickness = shells["Section thickness"]
    print(f"elements   {shells.n_cells} in {len(np.unique(thickness))} sections")
    print(f"thickness  {thickness.min():.3g} to {thickness.max():.3g}")
    # The back half, to look inside.
    draw({"Thickness": mesh, "Section thickness": shells.clip("-y")}, arguments.folder / "engine.png")


if __name__ == "__main__":
    main()
