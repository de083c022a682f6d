# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Thickness of thin walls by fits to gray values, and its uncertainty, against walls whose thickness is known."""

import json
import math
import random

import volumes
from program import DONE, REFUSED, USAGE, ProgramTestCase

AIR, METAL = 1000, 9000
THIN, THICK = -10, 9  # places of the two walls


def rise(x):
    return 0.5 * math.erfc(-x / math.sqrt(2))


def scan(thin=2.0, thick=8.0, size=(50, 44, 62), spacing=(1, 1, 1), blur=0.8, noise=0.05, normal=(1, 2, 5), seed=7):
    """Two tilted walls, blurred along the normal as in voxels, and the distances of the voxels from their middles."""
    dice = random.Random(seed)
    length = math.sqrt(sum(n * n for n in normal))
    normal = [n / length for n in normal]
    volume = volumes.Volume(size, [], spacing, "uint16")

    def wall(s, thickness, middle):
        return rise((s - middle + thickness / 2) / blur) - rise((s - middle - thickness / 2) / blur)

    def value(index):
        s = sum(n * (i - (extent - 1) / 2) for n, i, extent in zip(normal, index, size)) + 0.3
        share = wall(s, thin, THIN) + (wall(s, thick, THICK) if thick else 0)
        return max(0, round(AIR + (METAL - AIR) * (share + dice.gauss(0, noise))))

    volume.voxels = [value(index) for index in volume.indices()]
    return volume, normal


class GrayWallsTest(ProgramTestCase):
    def measure(self, name, *arguments, status=DONE):
        """Thickness, uncertainty and report."""
        self.run_program(
            "extract", name, "l.mha", "--thickness-map", "t.mha", "--overwrite", "--report", "r.json", *arguments,
            status=status,
        )  # fmt: skip
        return volumes.read_floats(self.folder / "t.mha"), json.loads((self.folder / "r.json").read_text("utf-8"))

    def cells_of(self, volume, normal, middle, values, margin=9):
        """Measures of the cells beside the middle of a wall."""
        size = volume.size
        found = []
        for i, value in enumerate(values):
            index = (i % size[0], i // size[0] % size[1], i // (size[0] * size[1]))
            s = 0.3 - middle + sum(
                n * (k + (0.5 if extent > 1 else 0) - (extent - 1) / 2)
                for n, k, extent in zip(normal, index, volume.size)
            )
            inside = all(margin <= k < extent - 1 - margin for k, extent in zip(index, volume.size) if extent > 1)
            if value != 0 and inside and abs(s) < 1.3:
                found.append(value)
        return found

    def check(self, values, thickness, bias, scale=1):
        self.assertGreater(len(values), 100)
        self.assertAlmostEqual(sum(values) / len(values), thickness * scale, delta=bias * scale)

    def test_fits_are_the_default_of_the_map(self):
        for thin in (1.6, 2.0, 3.0):
            volume, normal = scan(thin)
            volumes.write_nrrd(self.folder / "in.nrrd", volume)
            found, report = self.measure("in.nrrd", "--lower", 5000)
            self.assertEqual(report["measure"]["on"], "fits")
            self.assertIsNone(report["parameters"]["sub_voxel"])
            self.assertAlmostEqual(report["measure"]["scan"]["blur"], 0.8, delta=0.03)
            self.assertAlmostEqual(report["measure"]["scan"]["background"], AIR, delta=40)
            self.assertAlmostEqual(report["measure"]["scan"]["material"], METAL, delta=40)
            self.assertAlmostEqual(report["measure"]["scan"]["noise"], 400, delta=20)
            self.check(self.cells_of(volume, normal, THIN, found), thin, 0.03)
            self.check(self.cells_of(volume, normal, THICK, found), 8, 0.03)

    def test_the_object_can_be_asked_for(self):
        volume, _ = scan()
        volumes.write_nrrd(self.folder / "in.nrrd", volume)
        on_object, report = self.measure("in.nrrd", "--lower", 5000, "--sub-voxel=off")
        self.assertEqual(report["measure"], {"on": "object", "scan": None, "reason": "gray values are switched off", "uncertainty": None})
        volumes.write_nrrd(self.folder / "mask.nrrd", volumes.Volume(volume.size, [int(v >= 5000) for v in volume.voxels]))
        of_mask, report = self.measure("mask.nrrd", "--smooth", "off")
        self.assertEqual(on_object, of_mask)
        # A mask has values of its own at the threshold, or none in between.
        for scale, lower in ((1, 1), (255, 128)):
            values = [scale * int(v >= 5000) for v in volume.voxels]
            volumes.write_nrrd(self.folder / "mask.nrrd", volumes.Volume(volume.size, values))
            found, report = self.measure("mask.nrrd", "--lower", lower)
            self.assertEqual(found, of_mask)
            self.assertEqual(report["measure"]["on"], "object")
            self.assertNotEqual(report["measure"]["reason"], "")

    def test_meshes_of_masks_do_not_depend_on_the_threshold(self):
        """Layers of voxels of a tilted wall: 17 of them in three voxels."""
        normal = (1, 2, 5)
        places = 1 / math.sqrt(30)
        volume = volumes.Volume((60, 50, 50), [])
        middle = sum(n * (extent // 2) for n, extent in zip(normal, volume.size))

        def inside(index):
            return abs(sum(n * i for n, i in zip(normal, index)) - middle) <= 8

        metal = [inside(index) for index in volume.indices()]
        contents = set()
        for low, high, thresholds in ((0, 1, ((), ("--lower", 1))), (0, 255, (("--lower", lower) for lower in (1, 128, 255)))):
            values = [high if is_metal else low for is_metal in metal]
            volumes.write_nrrd(self.folder / "mask.nrrd", volumes.Volume(volume.size, values))
            for threshold in thresholds:
                arguments = ("mesh", "mask.nrrd", "mask.inp", *threshold, "--smooth", "off", "--overwrite", "--report", "-")
                report = json.loads(self.run_program(*arguments).stdout)  # elements are as long as walls are thick
                self.assertEqual(report["measure"]["on"], "object")
                self.assertAlmostEqual(report["thickness"]["mean"], 17 * places, delta=0.05 * 17 * places)
                contents.add((self.folder / "mask.inp").read_bytes())
        self.assertEqual(len(contents), 1)

    def test_a_threshold_that_no_value_reaches_does_not_count(self):
        volume, _ = scan()
        volumes.write_nrrd(self.folder / "in.nrrd", volume)
        expected, _ = self.measure("in.nrrd", "--lower", 5000)
        found, report = self.measure("in.nrrd", "--lower", 5000, "--upper", 65535)
        self.assertEqual(report["measure"]["on"], "fits")
        self.assertEqual(found, expected)

    def test_an_upper_threshold(self):
        volume, normal = scan()
        volume.voxels = [20000 - value for value in volume.voxels]
        volumes.write_nrrd(self.folder / "in.nrrd", volume)
        found, report = self.measure("in.nrrd", "--upper", 15000)
        self.assertEqual(report["measure"]["on"], "fits")
        self.check(self.cells_of(volume, normal, THIN, found), 2, 0.03)

    def test_unequal_spacing_and_pictures(self):
        spacing = (0.5, 0.5, 1.25)
        volume, normal = scan(spacing=spacing)
        # A wall of 2 voxels along the normal in voxels has this thickness.
        scale = 1 / math.sqrt(sum((n / s) ** 2 for n, s in zip(normal, spacing)))
        volumes.write_nrrd(self.folder / "in.nrrd", volume)
        found, report = self.measure("in.nrrd", "--lower", 5000)
        self.assertEqual(report["measure"]["on"], "fits")
        self.check(self.cells_of(volume, normal, THIN, found), 2, 0.04, scale)
        volume, normal = scan(size=(150, 120, 1), normal=(1, 3, 0))
        flat = volumes.Volume(volume.size[:2], volume.voxels, (1, 1), "uint16")
        volumes.write_nrrd(self.folder / "in.nrrd", flat)
        found, report = self.measure("in.nrrd", "--lower", 5000)
        self.assertEqual(report["measure"]["on"], "fits")
        self.check(self.cells_of(volume, normal, THIN, found), 2, 0.05)

    def test_intervals_hold_the_truth(self):
        for thin, noise in ((1.7, 0.1), (3.0, 0.2)):
            volume, normal = scan(thin, noise=noise)
            volumes.write_nrrd(self.folder / "in.nrrd", volume)
            found, report = self.measure("in.nrrd", "--lower", 5000, "--uncertainty-map", "u.mha")
            uncertainty = volumes.read_floats(self.folder / "u.mha")
            self.assertEqual([u != 0 for u in uncertainty], [t != 0 for t in found])
            pairs = self.cells_of(volume, normal, THIN, list(range(len(found))))
            held = [abs(found[i] - thin) <= uncertainty[i] for i in pairs if found[i] > 0]
            self.assertGreater(len(held), 100)
            self.assertGreater(sum(held) / len(held), 0.9)
            stated = report["measure"]["uncertainty"]
            self.assertEqual(stated["cells"], sum(u > 0 for u in uncertainty))
            known = sorted(u for u in uncertainty if u > 0)
            self.assertAlmostEqual(stated["mean"], sum(known) / len(known), delta=0.01)
            self.assertAlmostEqual(stated["percentiles"]["50"], known[len(known) // 2], delta=0.02)
            self.assertIn("noise", stated["covers"])
            self.assertIn("beam hardening", stated["leaves_out"])

    def check_the_same_bytes(self, volume, runs, *options):
        """Labels, maps and meshes are the same for all runs, and but for meshes for a job of 3 clusters."""
        volumes.write_nrrd(self.folder / "in.nrrd", volume)
        names = ("l.mha", "t.mha", "u.mha")
        meshes = [name for name in options if name.endswith(".vtp")]

        def run(*more):
            _, report = self.measure("in.nrrd", "--lower", 5000, "--uncertainty-map", "u.mha", *options, *more)
            files = [(self.folder / name).read_bytes() for name in (*names, *meshes)]
            return files, report["measure"], report["thickness"]

        expected = run("--threads", 1)
        self.assertEqual(expected[1]["on"], "fits")
        self.assertGreater(expected[1]["uncertainty"]["cells"], 100)
        for more in runs:
            self.assertEqual(run(*more), expected, more)
        self.run_program(
            "plan", "in.nrrd", "jl.mha", "job", "--divisions", 3, "--lower", 5000, "--thickness-map", "jt.mha",
            "--uncertainty-map", "ju.mha", "--report", "jr.json", "--overwrite",
        )  # fmt: skip
        for cluster in (2, 0, 1):
            self.run_program("work", "job", "--clusters", cluster)
        self.run_program("finalize", "job")
        for name, content in zip(names, expected[0]):
            self.assertEqual((self.folder / ("j" + name)).read_bytes(), content, name)
        report = json.loads((self.folder / "jr.json").read_text("utf-8"))
        self.assertEqual((report["measure"], report["thickness"]), expected[1:])

    def test_the_same_bytes_for_any_division(self):
        volume, _ = scan(size=(70, 30, 62), noise=0.2)
        more = (("--threads", 2), ("--divisions", 5), ("--divisions", 61, "--threads", 3), ("--memory", "64M"))
        self.check_the_same_bytes(volume, more, "--mesh", "m.vtp")

    def test_the_same_bytes_with_unequal_spacing(self):
        volume, _ = scan(size=(60, 30, 62), noise=0.2, spacing=(0.5, 0.5, 1.25))
        self.check_the_same_bytes(volume, (("--divisions", 5, "--threads", 2), ("--memory", "64M")))

    def test_the_same_bytes_of_a_picture(self):
        volume, _ = scan(size=(150, 120, 1), normal=(1, 3, 0), noise=0.1)
        flat = volumes.Volume(volume.size[:2], volume.voxels, (1, 1), "uint16")
        self.check_the_same_bytes(flat, (("--divisions", 5, "--threads", 2), ("--memory", "64M")))

    def test_levels(self):
        volume, normal = scan()
        volumes.write_nrrd(self.folder / "in.nrrd", volume)
        found, report = self.measure("in.nrrd", "--lower", 5000, "--materials", f"{AIR},{METAL}")
        self.assertEqual((report["measure"]["scan"]["background"], report["measure"]["scan"]["material"]), (AIR, METAL))
        self.assertEqual(report["parameters"]["materials"], [AIR, METAL])
        self.check(self.cells_of(volume, normal, THIN, found), 2, 0.03)
        low, _ = self.measure("in.nrrd", "--lower", 5000, "--materials", f"{AIR + 800},{METAL}")
        self.assertLess(sum(low), 0.95 * sum(found))  # a background that is too high makes walls thin

    def test_without_thick_walls_the_measure_of_the_threshold_remains(self):
        volume, _ = scan(3.0, None)
        volumes.write_nrrd(self.folder / "in.nrrd", volume)
        _, report = self.measure("in.nrrd", "--lower", 5000)
        self.assertEqual(report["measure"]["on"], "crossings")
        self.assertIn("5 voxels thick", report["measure"]["reason"])
        table = self.run_program("extract", "in.nrrd", "l.mha", "--lower", 5000, "--overwrite").stdout
        self.assertRegex(table, r"measured +where gray values cross the threshold: too few walls are 5 voxels thick")
        self.assert_fails(
            REFUSED, ["in.nrrd", "uncertainty", "5 voxels thick"],
            "extract", "in.nrrd", "o.mha", "--lower", 5000, "--uncertainty-map", "o2.mha",
        )  # fmt: skip
        self.assertFalse((self.folder / "o.mha").exists())

    def test_a_mesh_has_the_walls_that_the_run_has_measured(self):
        """Also of a thickness in voxels."""
        wall = volumes.blurred_wall(7)
        volumes.write_meta(self.folder / "in.mha", volumes.Volume(wall.size, wall.voxels, (0.5, 0.5, 0.5), wall.kind))
        self.run_program("mesh", "in.mha", "shared.ply", "--lower", 1000, "--thickness", 1.5)
        self.run_program("mesh", "in.mha", "own.ply", "--lower", 1000, "--thickness", "3vx")
        self.assertEqual((self.folder / "shared.ply").read_bytes(), (self.folder / "own.ply").read_bytes())

    def test_errors(self):
        volume, _ = scan(size=(20, 20, 20))
        volumes.write_nrrd(self.folder / "in.nrrd", volume)
        uncertainty = ("--uncertainty-map", "u.mha")
        for status, parts, arguments in (
            (USAGE, ["uncertainty", "threshold", "none is"], ("in.nrrd", "o.mha", *uncertainty)),
            (USAGE, ["uncertainty", "one threshold", "uint16"], ("in.nrrd", "o.mha", "--lower", 1, "--upper", 9, *uncertainty)),
            (USAGE, ["uncertainty", "no sub-voxel"], ("in.nrrd", "o.mha", "--lower", 1, "--sub-voxel=off", *uncertainty)),
            (USAGE, ["--materials", "5", "must differ"], ("in.nrrd", "o.mha", "--lower", 1, "--materials", "5,5")),
            (USAGE, ["--materials", "'5'", "background and material"], ("in.nrrd", "o.mha", "--lower", 1, "--materials", "5")),
            (USAGE, ["--materials", "sub-voxel"], ("in.nrrd", "o.mha", "--lower", 1, "--materials", "5,6", "--sub-voxel=off")),
        ):
            self.assert_fails(status, parts, "extract", *arguments)
