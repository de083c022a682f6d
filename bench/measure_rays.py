#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures the thickness by rays of medialvoxel surface on parts of known thickness, and area and volume of balls.

Usage: bench/measure_rays.py PROGRAM OUTPUT.json    needs numpy, scipy and plyfile
Plates in seven directions at three places, wedges, shells, tubes and rods, as masks and as gray values with a blur of 0.7 voxels, in
equal and unequal spacing. Errors are in units of the largest spacing; vertices near the faces of the volume are left out.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import numpy
import plyfile
from scipy.special import erf

SIZE = 60
BLUR = 0.7
SPACINGS = ((1.0, 1.0, 1.0), (0.7, 0.7, 1.2))
DIRECTIONS = ((0, 0, 1), (0, 1, 1), (1, 1, 1), (0.2588, 0, 0.9659), (1, 2, 5), (0.3183, 0.5772, 0.8), (2, 3, 6))
OFFSETS = (0.0, 0.37, 0.71)
WIDTHS = (1, 2, 3, 5, 8, 16)
ANGLES = (10, 20, 30)  # of wedges, degrees
MIDDLE = numpy.array([35.3, 35.4, 35.6]) * SIZE / 72
AXIS = numpy.array([0.0, -0.8, 0.6])
TYPES = {"uint8": "MET_UCHAR", "float32": "MET_FLOAT"}


def write_volume(path, voxels, spacing):
    header = {
        "ObjectType": "Image",
        "NDims": 3,
        "BinaryData": "True",
        "BinaryDataByteOrderMSB": "False",
        "ElementSpacing": " ".join(map(str, spacing)),
        "DimSize": " ".join(map(str, voxels.shape[::-1])),
        "ElementType": TYPES[str(voxels.dtype)],
        "ElementDataFile": "LOCAL",
    }
    path.write_bytes("".join(f"{key} = {value}\n" for key, value in header.items()).encode() + voxels.tobytes())


class Bench:
    def __init__(self, program, folder, spacing, is_gray):
        self.program, self.folder, self.spacing, self.is_gray = program, folder, numpy.array(spacing), is_gray
        self.unit = max(spacing)
        z, y, x = numpy.mgrid[:SIZE, :SIZE, :SIZE].astype(float)
        self.places = [(index - middle) * step for index, middle, step in zip((x, y, z), MIDDLE, spacing)]

    def layer(self, position, low, high):
        """Of material from low to high along a coordinate that grows by one per length."""
        if not self.is_gray:
            return ((position >= low) & (position <= high)).astype(numpy.uint8)
        scale = BLUR * self.unit * numpy.sqrt(2)
        return (0.5 * (erf((position - low) / scale) - erf((position - high) / scale))).astype(numpy.float32)

    def measure(self, voxels, length, margin):
        """Errors of the vertices, NaN without an answer, and the report. The length is one for all, or follows from points."""
        volume, surface, report = (self.folder / name for name in ("part.mha", "part.ply", "part.json"))
        write_volume(volume, voxels, self.spacing)
        command = [self.program, "surface", volume, surface, "--ray", "--report", report, "--overwrite", "--quiet"]
        command += ["--largest-ball", 40 * self.unit, *(("--lower", 0.5) if self.is_gray else ())]
        subprocess.run([str(word) for word in command], check=True)
        vertices = plyfile.PlyData.read(surface)["vertex"]
        points = numpy.stack([vertices[name] for name in "xyz"], axis=1)
        last = (SIZE - 1) * self.spacing
        inside = ((points > margin) & (points < last - margin)).all(axis=1)
        expected = length(points[inside]) if callable(length) else length
        return (vertices["ray_thickness"][inside] - expected) / self.unit, json.loads(report.read_text("utf-8"))["surface"]

    def plates(self):
        for width in WIDTHS:
            for direction in DIRECTIONS:
                normal = numpy.array(direction) / numpy.linalg.norm(direction)
                position = sum(n * place for n, place in zip(normal, self.places))
                errors = []
                if self.is_gray and width < 2:
                    continue  # below the threshold
                for offset in OFFSETS:
                    half = width * self.unit / 2
                    voxels = self.layer(position + offset * self.unit, -half, half)
                    errors.append(self.measure(voxels, 2 * half, 1.1 * 2 * half * abs(normal) + 3 * self.unit)[0])
                yield {"part": "plate", "width": width, "direction": direction, **describe(numpy.concatenate(errors))}

    def wedges(self):
        """A ray that is perpendicular to one face; lengths of less than 3 and near the faces of the volume do not count."""
        x, _, z = self.places
        tip = x.min() + 2 * self.unit
        for degrees in ANGLES:
            angle = numpy.radians(degrees)
            sides = [(x - tip) * numpy.sin(angle / 2) + sign * z * numpy.cos(angle / 2) for sign in (-1, 1)]
            first, second = (self.layer(side, 0, 1e6) for side in sides)
            voxels = first * second if first.dtype == numpy.uint8 else first + second - 1

            def length(points, angle=angle):
                places = points - MIDDLE * self.spacing
                found = numpy.hypot(places[:, 0] - tip, places[:, 2]) * numpy.tan(angle)
                return numpy.where((found > 3 * self.unit) & (places[:, 0] < 0.25 * SIZE * self.spacing[0]), found, numpy.inf)

            errors = self.measure(voxels, length, 3 * self.unit)[0]
            yield {"part": "wedge", "degrees": degrees, **describe(errors[errors > -numpy.inf])}

    def round_parts(self):
        radius = numpy.sqrt(sum(place**2 for place in self.places))
        along = sum(a * place for a, place in zip(AXIS, self.places))
        across = numpy.sqrt(numpy.maximum(0, radius**2 - along**2))
        for name, position, low, high in (
            ("ball", radius, -10, 10),
            ("shell", radius, 10, 14),
            ("tube", across, 10, 14),
            ("thin tube", across, 6, 8),
            ("rod", across, -1.5, 1.5),
            ("rod", across, -2.5, 2.5),
            ("rod", across, -4, 4),
        ):
            errors, surface = self.measure(self.layer(position, low * self.unit, high * self.unit), (high - low) * self.unit, 5 * self.unit)
            row = {"part": name, "radii": [low, high], **describe(errors)}
            if name == "ball":
                row["area_ratio"] = surface["area"] / (4 * numpy.pi * (high * self.unit) ** 2)
                row["volume_ratio"] = surface["volume"] / (4 / 3 * numpy.pi * (high * self.unit) ** 3)
            yield row


def describe(errors):
    known = errors[numpy.isfinite(errors)]
    mean, deviation = float(known.mean()), float(known.std())
    return {"mean_error": mean, "deviation": deviation, "unanswered": 1 - len(known) / len(errors)}


def main():
    program, output = sys.argv[1:]
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for spacing in SPACINGS:
            for is_gray in (False, True):
                bench = Bench(program, pathlib.Path(folder), spacing, is_gray)
                for row in [*bench.plates(), *bench.wedges(), *bench.round_parts()]:
                    rows.append({"spacing": spacing, "values": "gray" if is_gray else "mask", **row})
    text = json.dumps({"size": SIZE, "blur": BLUR, "rows": rows}, indent=1)
    pathlib.Path(output).write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
