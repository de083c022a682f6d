#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Shell meshes of plates and of real parts, solved by CalculiX: deflection against theory, and elements that it refuses.

Plates are held at one rim, loaded at the other one. They are bent as beams: Poisson's ratio is 0. The length is that of
the sheet, which ends half a thickness inside the plate. Needs numpy and CalculiX (Debian package calculix-ccx).
"""

import argparse
import itertools
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import numpy

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.append(str(FOLDER.parent / "examples/fem"))

from shell_model import ShellModel, solve  # noqa: E402

MODULUS = 210000.0
LENGTH, WIDTH = 80, 40  # voxels
MARGIN = 4
STEPS = 6  # samples of a voxel along each axis, for its share of the plate

TILTS = {
    "axis": (0, 0, 1),
    "15 degrees": (0.2588, 0, 0.9659),
    "(1,2,5)": (1, 2, 5),
    "(1,1,1)": (1, 1, 1),
    "45 degrees": (1, 0, 1),
}
PARTS = {"engine.mha": 72, "shell.nrrd": 65, "cranium.mha": 200}


def axes_of(normal):
    """Length, width and normal of a plate, as rows."""
    w = numpy.array(normal, float) / numpy.linalg.norm(normal)
    u = numpy.array([1.0, 0, 0]) - w[0] * w
    u /= numpy.linalg.norm(u)
    return numpy.array([u, numpy.cross(w, u), w])


class Plate:
    """Of so many voxels, in the middle of an image."""

    def __init__(self, thickness, normal):
        self.size = numpy.array([LENGTH, WIDTH, thickness], float)
        self.axes = axes_of(normal)
        half = numpy.abs(self.axes.T) @ (self.size / 2)
        self.image = (2 * numpy.ceil(half + MARGIN)).astype(int)
        # Not halfway between voxels, where a plate of three would have four layers.
        self.center = (self.image - 1) // 2 + numpy.array([0.2, 0.3, 0.4])

    def to_plate(self, points):
        return (points - self.center) @ self.axes.T

    def write(self, path, is_gray):
        """As MetaImage: 255 for metal, shares of it at the faces, or only voxels whose middle is inside."""
        offsets = [(step + 0.5) / STEPS - 0.5 for step in range(STEPS)] if is_gray else [0.0]
        x, y, z = (numpy.arange(size) for size in self.image)
        share = numpy.zeros(self.image[::-1])
        for offset in itertools.product(offsets, repeat=3):
            inside = numpy.ones(share.shape, bool)
            for axis in range(3):
                u = sum(
                    self.axes[axis, k] * (values + offset[k] - self.center[k]).reshape(shape)
                    for k, (values, shape) in enumerate(((x, (1, 1, -1)), (y, (1, -1, 1)), (z, (-1, 1, 1))))
                )
                inside &= numpy.abs(u) <= self.size[axis] / 2
            share += inside
        values = numpy.round(255 * share / len(offsets) ** 3).astype(numpy.uint8)
        header = (
            "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
            f"ElementSpacing = 1 1 1\nDimSize = {' '.join(map(str, self.image))}\n"
            "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n"
        )
        path.write_bytes(header.encode("ascii") + values.tobytes())


def beam_deflection(force_at, seen_at, rigidity):
    """Of a beam that is held at 0, at one place by a unit force at another."""
    near, far = sorted((force_at, seen_at))
    return near**2 * (3 * far - near) / (6 * rigidity)


def bend(model, plate, folder):
    """Deflection of the loaded rim over that of a beam as wide as the plate, and as wide as the sheet."""
    numbers = list(model.nodes)
    places = plate.to_plate(numpy.array([model.nodes[number] for number in numbers]))
    x = places[:, 0]
    held = [number for number, value in zip(numbers, x) if value < x.min() + 1]
    loaded = [(number, value) for number, value in zip(numbers, x) if value > x.max() - 1]
    begin = numpy.mean([value for value in x if value < x.min() + 1])
    force = tuple(map(float, plate.axes[2] / len(loaded)))
    moved = solve(model, (MODULUS, 0.0), held, {number: force for number, _ in loaded}, folder)
    deflection = numpy.mean([numpy.dot(moved[number], plate.axes[2]) for number, _ in loaded])
    lengths = [value - begin for _, value in loaded]
    rigidity = MODULUS * plate.size[2] ** 3 / 12
    theory = sum(beam_deflection(a, b, rigidity) for a in lengths for b in lengths) / len(loaded) ** 2
    width = area_of(model) / numpy.ptp(x)
    return deflection * plate.size[1] / theory - 1, deflection * width / theory - 1


def area_of(model):
    area = 0.0
    for keyword, lines in model.blocks:
        for line in lines if keyword.startswith("*ELEMENT") else ():
            first, *others = (numpy.array(model.nodes[int(node)]) for node in line.split(",")[1:])
            for second, third in zip(others, others[1:]):
                area += numpy.linalg.norm(numpy.cross(second - first, third - first)) / 2
    return area


def count_refused(message):
    return len(set(re.findall(r"determinant in element\s+(\d+)", message)))


def mesh(program, source, target, *arguments):
    subprocess.run([program, "mesh", source, target, "--element-size", "auto", "--overwrite", "--quiet", *arguments], check=True)
    return ShellModel(target)


def solve_plate(program, thickness, tilt, is_gray, folder):
    plate = Plate(thickness, TILTS[tilt])
    plate.write(folder / "plate.mha", is_gray)
    arguments = ["--lower", "128"] + (["--sub-voxel"] if is_gray else [])
    model = mesh(program, folder / "plate.mha", folder / "plate.inp", *arguments)
    row = {"plate": tilt, "thickness": thickness, "values": "gray" if is_gray else "binary"}
    row["elements"] = model.number_of_elements()
    try:
        of_plate, of_sheet = bend(model, plate, folder)
        row |= {"refused": 0, "error_percent": round(100 * of_plate, 2), "error_with_width_percent": round(100 * of_sheet, 2)}
    except RuntimeError as error:
        row["refused"] = count_refused(str(error)) or str(error)[-200:]
    return row


def solve_part(program, source, threshold, folder):
    """Held at its lowest nodes, pulled at its highest one."""
    start = time.monotonic()
    model = mesh(program, source, folder / "part.inp", "--lower", str(threshold))
    row = {"part": source.name, "elements": model.number_of_elements(), "mesh_seconds": round(time.monotonic() - start, 1)}
    heights = {number: point[2] for number, point in model.nodes.items()}
    low = min(heights.values())
    held = [number for number, height in heights.items() if height < low + 5]
    start = time.monotonic()
    try:
        moved = solve(model, (70000.0, 0.33), held, {max(heights, key=heights.get): (0.0, 0.0, 1.0)}, folder)
        row |= {"refused": 0, "is_finite": bool(numpy.isfinite(list(moved.values())).all())}
    except RuntimeError as error:
        row["refused"] = count_refused(str(error)) or str(error)[-200:]
    row["solver_seconds"] = round(time.monotonic() - start, 1)
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="medialvoxel", help="the program medialvoxel")
    parser.add_argument("--data", type=pathlib.Path, help="folder of the real parts; none: plates only")
    parser.add_argument("--thickness", default="3,4,6,8", help="of the plates in voxels (%(default)s)")
    parser.add_argument("--output", type=pathlib.Path, default=FOLDER / "results/shells.json", help="(%(default)s)")
    arguments = parser.parse_args()
    version = subprocess.run(["ccx", "-v"], capture_output=True, text=True, check=False).stdout.strip()
    results = {"solver": "CalculiX " + version.split()[-1], "plates": [], "parts": []}
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        for thickness, tilt, is_gray in itertools.product(arguments.thickness.split(","), TILTS, (False, True)):
            results["plates"].append(solve_plate(arguments.program, int(thickness), tilt, is_gray, folder))
            print(json.dumps(results["plates"][-1]), flush=True)
        for name, threshold in PARTS.items() if arguments.data else ():
            results["parts"].append(solve_part(arguments.program, arguments.data / name, threshold, folder))
            print(json.dumps(results["parts"][-1]), flush=True)
    arguments.output.write_text(json.dumps(results, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
