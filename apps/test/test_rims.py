# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Meshes whose rims are extended, against the parts that the volumes were made from."""

import collections
import json
import math
import os
import pathlib
import random
import shutil
import sys
import unittest

import volumes
from program import USAGE, ProgramTestCase

SOURCE = pathlib.Path(os.environ["MEDIALVOXEL_SOURCE"])
sys.path.append(str(SOURCE / "examples/fem"))

from shell_model import ShellModel, solve  # noqa: E402

DATA = SOURCE / "../shared/data"
PARTS = {"engine.mha": 72, "shell.nrrd": 65, "cranium.mha": 200}


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def subtract(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return tuple(a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3))


def norm(a):
    return math.sqrt(dot(a, a))


def axes_of(normal):
    """Length, width and normal of a plate."""
    w = tuple(x / norm(normal) for x in normal)
    u = subtract((1, 0, 0), tuple(w[0] * x for x in w))
    u = tuple(x / norm(u) for x in u)
    return u, cross(w, u), w


class Plate:
    """A part round the middle of a volume: a profile in the plane of its axes, of one thickness.

    inside(u, v) tells of a place of the plane whether the profile is there."""

    def __init__(self, inside, half, thickness, normal=(0, 0, 1), spacing=(1, 1, 1), phase=(0.2, 0.3, 0.4)):
        self.inside = inside
        self.thickness = thickness
        self.axes = axes_of(normal)
        self.spacing = spacing
        extent = [sum(abs(a[k]) * h for a, h in zip(self.axes, (*half, thickness / 2))) for k in range(3)]
        self.size = tuple(2 * math.ceil(e / s + 4) for e, s in zip(extent, spacing))
        self.center = tuple(((n - 1) // 2 + p) * s for n, p, s in zip(self.size, phase, spacing))

    def to_plate(self, point):
        place = subtract(point, self.center)
        return tuple(dot(place, axis) for axis in self.axes)

    def value(self, index):
        """Gray: the share of a voxel that is metal, from one sample and the distance to the faces."""
        u, v, w = self.to_plate([i * s for i, s in zip(index, self.spacing)])
        depth = min(self.thickness / 2 - abs(w), self.inside(u, v))
        return max(0, min(255, round(128 + 255 * depth / max(self.spacing))))

    def write(self, path, is_gray=True):
        volume = volumes.Volume(self.size, [], self.spacing)
        volume.voxels = [self.value(index) for index in volume.indices()]
        if not is_gray:
            volume.voxels = [255 * (value >= 128) for value in volume.voxels]
        volumes.write_meta(path, volume)


def rectangle(length, width):
    return lambda u, v: min(length / 2 - abs(u), width / 2 - abs(v))


def disk(radius, hole=0):
    return lambda u, v: min(radius - math.hypot(u, v), math.hypot(u, v) - hole if hole else math.inf)


class Mesh:
    """Of an .inp file."""

    def __init__(self, path):
        self.model = ShellModel(path)
        self.points = {number: tuple(map(float, point)) for number, point in self.model.nodes.items()}
        self.elements = [
            [int(node) for node in line.split(",")][1:]
            for keyword, lines in self.model.blocks
            if keyword.startswith("*ELEMENT")
            for line in lines
        ]

    def area(self):
        total = 0.0
        for first, *others in self.elements:
            for second, third in zip(others, others[1:]):
                edges = [subtract(self.points[node], self.points[first]) for node in (second, third)]
                total += norm(cross(*edges)) / 2
        return total

    def count_sides(self):
        return collections.Counter(
            frozenset(side) for nodes in self.elements for side in zip(nodes, nodes[1:] + nodes[:1])
        )

    def rim(self, step=0.5):
        """Places on sides of one element."""
        places = []
        for side, number in self.count_sides().items():
            if number == 1:
                a, b = (self.points[node] for node in side)
                parts = math.ceil(norm(subtract(a, b)) / step)
                for k in range(parts):
                    places.append(tuple(x + (y - x) * k / parts for x, y in zip(a, b)))
        return places


class RimsTestCase(ProgramTestCase):
    def mesh(self, name="m.inp", *arguments):
        run = ["mesh", "in.mha", name, "--lower", 128, "--element-size", "auto", "--extend-rims", "--sub-voxel"]
        mesh = json.loads(self.run_program(*run, "--report", "-", "--overwrite", *arguments).stdout)["mesh"]
        self.assert_limits_hold(mesh)
        return mesh

    def assert_limits_hold(self, mesh):
        self.assertEqual([limit for limit in mesh["quality"]["limits"] if not limit["holds"]], [])

    def check_plate(self, plate, area, *arguments, outline=0.1, share=0.012, is_gray=True):
        """The area within a share, and the mean distance of rims to the outline; elements that the check takes."""
        plate.write(self.folder / "in.mha", is_gray)
        summary = self.mesh("m.inp", *arguments)
        mesh = Mesh(self.folder / "m.inp")
        self.assertAlmostEqual(mesh.area() / area, 1, delta=share)
        gaps = [plate.inside(*plate.to_plate(place)[:2]) for place in mesh.rim()]
        self.assertLess(abs(sum(gaps) / len(gaps)), outline * max(plate.spacing))
        self.assertLessEqual(summary["remeshing"]["rims"]["points_cut_back"], 2)
        return mesh


class PlatesTest(RimsTestCase):
    def test_plates_have_their_size_again(self):
        for normal in ((0, 0, 1), (0.2588, 0, 0.9659), (1, 2, 5), (1, 1, 1)):
            plate = Plate(rectangle(40, 24), (20, 12), 4, normal)
            mesh = self.check_plate(plate, 40 * 24)
            # All corners are there.
            places = [plate.to_plate(point) for point in mesh.points.values()]
            for u in (-20, 20):
                for v in (-12, 12):
                    self.assertLess(min(math.hypot(p[0] - u, p[1] - v) for p in places), 1.5)

    def test_flat_walls_are_flat(self):
        # A slope of one voxel in twenty has long steps; nodes of coarse elements would be up to half a voxel off.
        for is_gray, slope in ((True, 0.05), (False, 0.05), (True, 0.27), (False, 0.15)):
            plate = Plate(rectangle(80, 50), (40, 25), 5, (slope, 0.3 * slope, 1))
            plate.write(self.folder / "in.mha", is_gray)
            self.mesh()
            heights = [plate.to_plate(point)[2] for point in Mesh(self.folder / "m.inp").points.values()]
            mean = sum(heights) / len(heights)
            # A mask is as thick as its layers: its middle may be off, but not one node from another.
            self.assertLess(abs(mean), 0.02 if is_gray else 0.1)
            off = sorted(abs(height - mean) for height in heights)
            self.assertLess(off[int(0.99 * len(off))], 0.05, (is_gray, slope))
            self.assertLess(off[-1], 0.15, (is_gray, slope))

    def test_of_a_mask(self):
        self.check_plate(Plate(rectangle(40, 24), (20, 12), 4), 40 * 24, is_gray=False)

    def test_any_phase_and_spacing(self):
        generator = random.Random(24)
        for _ in range(3):
            spacing = tuple(generator.uniform(0.5, 1.2) for _ in range(3))
            phase = tuple(generator.random() for _ in range(3))
            normal = tuple(generator.gauss(0, 1) for _ in range(3))
            plate = Plate(rectangle(34, 26), (17, 13), 4.5, normal, spacing, phase)
            self.check_plate(plate, 34 * 26, outline=0.2)

    def test_disk_and_hole(self):
        self.check_plate(Plate(disk(18), (18, 18), 4), math.pi * 18**2, outline=0.3, share=0.03)
        mesh = self.check_plate(Plate(disk(22, 8), (22, 22), 4), math.pi * (22**2 - 8**2), outline=0.3, share=0.03)
        sides = mesh.count_sides()
        nodes = {node for nodes in mesh.elements for node in nodes}
        self.assertEqual(len(nodes) - len(sides) + len(mesh.elements), 0)  # the hole stays

    def test_profile(self):
        # A T of walls of 4: flange 30 wide, web 20 high below its middle, 40 long.
        volume = volumes.Volume((48, 38, 30), [])
        volume.voxels = [
            255 * (4 <= x < 44 and (4 <= y < 34 and 20 <= z < 24 or 17 <= y < 21 and 4 <= z < 20))
            for x, y, z in volume.indices()
        ]
        volumes.write_meta(self.folder / "in.mha", volume)
        self.mesh()
        mesh = Mesh(self.folder / "m.inp")
        self.assertAlmostEqual(mesh.area() / (40 * 30 + 40 * 18), 1, delta=0.022)  # the web ends where the flange begins
        low, high = ([pick(p[k] for p in mesh.points.values()) for k in range(3)] for pick in (min, max))
        for value, expected in zip(low + high, (3.5, 3.5, 3.5, 43.5, 33.5, 21.5)):
            self.assertAlmostEqual(value, expected, delta=0.35)
        # The junction goes to both ends.
        ends = [
            self_point[0]
            for side, number in mesh.count_sides().items()
            if number > 2
            for self_point in (mesh.points[node] for node in side)
        ]
        self.assertLess(min(ends), 4.2)
        self.assertGreater(max(ends), 42.8)

    def test_another_material_at_the_edge(self):
        # A plate of 4 between two limits; from x = 40 on all is brighter.
        volume = volumes.Volume((56, 34, 14), [])
        volume.voxels = [
            220 if x >= 40 else 150 * (5 <= z < 9 and 4 <= y < 30 and x >= 4) for x, y, z in volume.indices()
        ]
        volumes.write_meta(self.folder / "in.mha", volume)
        run = ("mesh", "in.mha", "m.inp", "--lower", 75, "--upper", 185, "--sub-voxel", "--extend-rims", "--report", "-")
        rims = json.loads(self.run_program(*run).stdout)["mesh"]["remeshing"]["rims"]
        self.assertEqual(rims["sides_without_surface"], 0)
        x = [point[0] for point in Mesh(self.folder / "m.inp").points.values()]
        self.assertAlmostEqual(min(x), 3.5, delta=0.4)
        self.assertAlmostEqual(max(x), 39.5, delta=0.4)

    def test_same_bytes_for_any_division(self):
        Plate(rectangle(40, 24), (20, 12), 4, (1, 2, 5)).write(self.folder / "in.mha")
        contents = set()
        for arguments in (["--divisions", 1, "--threads", 1], ["--divisions", 7, "--threads", 3]):
            self.mesh("m.inp", *arguments)
            contents.add((self.folder / "m.inp").read_bytes())
        self.assertEqual(len(contents), 1)

    def test_labels_have_no_surface_to_find(self):
        plate = Plate(rectangle(40, 24), (20, 12), 4)
        plate.write(self.folder / "in.mha", is_gray=False)
        run = ("mesh", "in.mha", "m.inp", "--label", 255, "--element-size", "auto", "--extend-rims", "--report", "-")
        rims = json.loads(self.run_program(*run).stdout)["mesh"]["remeshing"]["rims"]
        self.assertLess(rims["sides_without_surface"], rims["sides"])

    def test_errors(self):
        Plate(rectangle(20, 20), (10, 10), 4).write(self.folder / "in.mha")
        source = ("mesh", "in.mha", "m.vtp", "--lower", 128, "--extend-rims")
        self.assert_fails(USAGE, ["element size", "auto"], *source)
        self.assert_fails(USAGE, ["element size", "auto"], *source, "--element-size", "voxel")


@unittest.skipUnless(DATA.is_dir(), f"{DATA} not found")
class RealRimsTest(RimsTestCase):
    def test_real_parts(self):
        for name, threshold in PARTS.items():
            run = ("mesh", DATA / name, "part.inp", "--lower", threshold, "--element-size", "auto", "--overwrite")
            area = json.loads(self.run_program(*run, "--report", "-", "--extend-rims=off").stdout)["mesh"]["area"]
            mesh = json.loads(self.run_program(*run, "--report", "-", "--extend-rims").stdout)["mesh"]
            rims = mesh["remeshing"]["rims"]
            self.assert_limits_hold(mesh)
            self.assertGreater(mesh["area"], area)
            self.assertLess(mesh["area"], mesh["remeshing"]["area_before"] + 1.1 * rims["area"])
            if shutil.which("ccx"):
                model = ShellModel(self.folder / "part.inp")
                heights = {number: point[2] for number, point in model.nodes.items()}
                held = [number for number, height in heights.items() if height < min(heights.values()) + 5]
                # Raises where the solver refuses an element.
                solve(model, (70000.0, 0.33), held, {max(heights, key=heights.get): (0.0, 0.0, 1.0)}, self.folder)


if __name__ == "__main__":
    unittest.main()
