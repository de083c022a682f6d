#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""A plate of voxels becomes a shell mesh, is held at one end, bent by a force at the other, and compared with theory.

Needs the program medialvoxel and CalculiX (Debian package calculix-ccx). Ends with status 1 when the deflection is
more than 5 % off.
"""

import argparse
import math
import pathlib
import subprocess
import sys
import tempfile

from shell_model import ShellModel, solve

MODULUS = 210000.0  # N/mm^2
# Without lateral contraction a plate of any width bends as a beam: theory is exact.
POISSON_RATIO = 0.0
FORCE = 1.0  # N
TOLERANCE = 0.05
THRESHOLD = 128


class Plate:
    """A plate in voxels, its length tilted about the y axis; x, y, z of the plate begin at its corner."""

    def __init__(self, length, width, thickness, spacing, tilt):
        self.size = (length * spacing, width * spacing, thickness * spacing)
        self.voxels = (length, width, thickness)
        self.spacing = spacing
        self.cosine, self.sine = math.cos(math.radians(tilt)), math.sin(math.radians(tilt))
        margin = 5
        self.image_size = (
            math.ceil(length * self.cosine + thickness * self.sine) + 2 * margin,
            width + 2 * margin,
            math.ceil(length * self.sine + thickness * self.cosine) + 2 * margin,
        )
        # Voxel faces, not centers, lie on the faces of a plate that is not tilted.
        self.corner = (
            (margin - 0.5 + thickness * self.sine) * spacing,
            (margin - 0.5) * spacing,
            (margin - 0.5) * spacing,
        )

    def to_plate(self, point):
        return self.turn_back([value - corner for value, corner in zip(point, self.corner)])

    def turn_back(self, vector):
        x, y, z = vector
        return x * self.cosine + z * self.sine, y, z * self.cosine - x * self.sine

    def turn(self, vector):
        x, y, z = vector
        return x * self.cosine - z * self.sine, y, x * self.sine + z * self.cosine

    def share(self, x, z):
        """Of a voxel that is in the plate, in a section across its width."""
        steps = 8
        offsets = [((step + 0.5) / steps - 0.5) * self.spacing for step in range(steps)]
        inside = 0
        for dx in offsets:
            for dz in offsets:
                u, _, w = self.to_plate((x * self.spacing + dx, 0, z * self.spacing + dz))
                inside += 0 <= u <= self.size[0] and 0 <= w <= self.size[2]
        return inside / steps**2

    def write(self, path, blur):
        """As MetaImage with 255 for metal, blurred by a Gaussian of so many voxels."""
        columns, rows, slices = self.image_size
        margin = (rows - self.voxels[1]) // 2
        header = (
            "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
            f"ElementSpacing = {self.spacing} {self.spacing} {self.spacing}\nDimSize = {columns} {rows} {slices}\n"
            "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n"
        )
        # A section across the width, and a line along it, make the plate: their products are its values.
        section = [blurred([self.share(x, z) for x in range(columns)], blur) for z in range(slices)]
        section = list(zip(*(blurred(line, blur) for line in zip(*section))))
        width = blurred([0.0] * margin + [1.0] * self.voxels[1] + [0.0] * margin, blur)
        with open(path, "wb") as file:
            file.write(header.encode("ascii"))
            for line in section:
                file.write(b"".join(bytes(round(255 * share * value) for value in line) for share in width))


def blurred(values, sigma):
    """A line of values after a Gaussian; beyond its ends they are zero."""
    if sigma == 0:
        return list(values)
    reach = math.ceil(4 * sigma)
    weights = [math.exp(-0.5 * (step / sigma) ** 2) for step in range(-reach, reach + 1)]
    padded = [0.0] * reach + list(values) + [0.0] * reach
    return [
        sum(weight * value for weight, value in zip(weights, padded[place:])) / sum(weights)
        for place in range(len(values))
    ]


def beam_deflection(force_at, seen_at, rigidity):
    """Of a beam that is held at 0, at one place by a unit force at another."""
    near, far = sorted((force_at, seen_at))
    return near**2 * (3 * far - near) / (6 * rigidity)


def bend(model, plate, folder):
    """Deflections at the loaded end, of the mesh and by theory with the dimensions of the plate, and the mesh's width.

    A medial sheet begins half a thickness inside the part. So the length is counted on the sheet, from the last nodes
    that are held to the loaded ones, and the sheet is less wide than the plate."""
    places = {number: plate.to_plate(point) for number, point in model.nodes.items()}
    clamp = plate.size[0] / 8
    end = max(x for x, _, _ in places.values())
    held = {number for number, (x, _, _) in places.items() if x <= clamp}
    loaded = [number for number, (x, _, _) in places.items() if x > end - plate.spacing]
    begin = max(places[number][0] for number in held)
    force = plate.turn((0, 0, FORCE / len(loaded)))
    moved = solve(model, (MODULUS, POISSON_RATIO), sorted(held), {number: force for number in loaded}, folder)
    deflection = sum(plate.turn_back(moved[number])[2] for number in loaded) / len(loaded)

    rigidity = MODULUS * plate.size[1] * plate.size[2] ** 3 / 12
    lengths = [places[number][0] - begin for number in loaded]
    theory = sum(beam_deflection(a, b, rigidity) for a in lengths for b in lengths) * FORCE / len(loaded) ** 2
    sides = [y for _, y, _ in places.values()]
    return deflection, theory, max(sides) - min(sides)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="medialvoxel", help="the program medialvoxel")
    parser.add_argument("--mesh", help="take this mesh of the plate instead of making one")
    parser.add_argument("--size", default="160,100,4", help="length, width and thickness in voxels (%(default)s)")
    parser.add_argument("--spacing", type=float, default=0.5, help="of the voxels in mm (%(default)s)")
    parser.add_argument("--tilt", type=float, default=0.0, help="of the plate against the voxels, in degrees")
    parser.add_argument("--blur", type=float, default=0.0, help="of the scan, sigma in voxels (%(default)s)")
    parser.add_argument("--tau", default="auto", help="option --thickness of medialvoxel, in voxels (%(default)s)")
    parser.add_argument("--sub-voxel", action="store_true", help="measure on the gray values")
    parser.add_argument("--folder", help="keep all files here")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    plate = Plate(*map(int, arguments.size.split(",")), arguments.spacing, arguments.tilt)
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(arguments.folder or temporary)
        mesh = arguments.mesh
        if mesh is None:
            mesh = folder / "plate.inp"
            plate.write(folder / "plate.mha", arguments.blur)
            command = [arguments.program, "mesh", folder / "plate.mha", mesh, "--lower", str(THRESHOLD)]
            command += ["--thickness", arguments.tau if arguments.tau == "auto" else arguments.tau + "vx", "--overwrite", "--quiet"]
            command += ["--element-size", "voxel"]
            command += ["--sub-voxel"] if arguments.sub_voxel else []
            subprocess.run(command, check=True)
        model = ShellModel(mesh)
        deflection, theory, width = bend(model, plate, folder)
    error = deflection / theory - 1
    sections = model.sections().values()
    print(f"elements      {model.number_of_elements()}")
    print(f"thickness     {min(sections):.4g} to {max(sections):.4g} mm in {len(sections)} sections, {plate.size[2]:.4g} wanted")
    print(f"deflection    {deflection:.6g} mm, by theory {theory:.6g} mm: {error:+.2%}")
    print(f"of it         {plate.size[1] / width - 1:+.2%} because the sheet is {width:.4g} mm wide, the plate {plate.size[1]:.4g} mm")
    return 0 if abs(error) <= TOLERANCE else 1


if __name__ == "__main__":
    sys.exit(main())
