# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Thickness at the voxels: of walls and of largest balls, against a search over all balls and voxels."""

import json
import math
import statistics
import random
import unittest

import volumes
from program import USAGE, ProgramTestCase

SIZE = (17, 14, 12)
SPACING = (0.7, 0.7, 1.2)
CAP = 5.0


def random_blobs(size=SIZE, seed=3):
    """Unions of random balls, and some single voxels: pores and grains."""
    draw = random.Random(seed)
    balls = [([draw.uniform(0, n) for n in size], draw.uniform(1, 5)) for _ in range(9)]
    noise = {tuple(draw.randrange(n) for n in size) for _ in range(12)}
    return [
        60 * ((min(sum((a - b) ** 2 for a, b in zip(index, center)) - radius**2 for center, radius in balls) < 0) != (index in noise))
        for index in volumes.Volume(size, []).indices()
    ]


def largest_balls(indices, voxels, spacing, cap):
    """Twice the radius of the largest ball in the object that covers a voxel. Radii lead to the nearest background."""

    def squared(a, b):
        return sum(((p - q) * s) ** 2 for p, q, s in zip(a, b, spacing))

    inside = [index for index, value in zip(indices, voxels) if value]
    outside = [index for index, value in zip(indices, voxels) if not value]
    radii = {index: min((cap / 2) ** 2, min(squared(index, other) for other in outside)) for index in inside}
    found = []
    for index, value in zip(indices, voxels):
        covering = (radius for center, radius in radii.items() if squared(center, index) < radius * (1 - 1e-12))
        found.append(2 * max(covering) ** 0.5 if value else 0.0)
    return found


def distance(a, b, spacing):
    return sum(((p - q) * s) ** 2 for p, q, s in zip(a, b, spacing)) ** 0.5


def boundary_points_of(cell, nearest, spacing):
    """The boundary points of a cell's corners that are seen under the widest angle from its center."""
    center = [index + 0.5 for index in cell]
    best = None
    for k in range(4):
        ends = [nearest(tuple(index + (corner >> axis & 1) for axis, index in enumerate(cell))) for corner in (k, 7 - k)]
        a, b = ([(p - q) * s for p, q, s in zip(end, center, spacing)] for end in ends)
        dot = sum(p * q for p, q in zip(a, b))
        key = dot * abs(dot) / (sum(p * p for p in a) * sum(p * p for p in b))
        if best is None or key < best[0]:
            best = (key, *ends)
    return best[1:]


def thickest_walls(indices, voxels, spacing, cap, thickness, vectors):
    """The thickness of the wall whose ball is the largest that covers a voxel; NaN without one."""
    at = {index: number for number, index in enumerate(indices)}

    def nearest(index):
        vector = vectors[3 * at[index] : 3 * at[index] + 3]
        return tuple(round(i + v / s) for i, v, s in zip(index, vector, spacing))  # of background: itself

    balls = []
    for cell, value in zip(indices, thickness):
        if value > 0:
            center = [index + 0.5 for index in cell]
            radius = sum(distance(point, center, spacing) for point in boundary_points_of(cell, nearest, spacing)) / 2
            balls.append((center, min(radius, cap / 2) - 1e-9, min(value, cap)))
    found = []
    for index, value in zip(indices, voxels):
        covering = ((radius, wall) for center, radius, wall in balls if distance(center, index, spacing) < radius)
        found.append(max(covering, default=(0, math.nan))[1] if value else 0.0)
    return found


class LocalThicknessTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.volume = volumes.Volume(SIZE, random_blobs(), SPACING)
        self.indices = list(self.volume.indices())
        volumes.write_meta(self.folder / "in.mha", self.volume)

    def measure(self, *options, method="sphere"):
        """Runs the program; the default of the method is wall."""
        options = (*options, *(("--local-thickness-method", method) if method else ()))
        self.run_program(
            "extract", "in.mha", "out.mha", "--local-thickness", "t.mha", "--report", "r.json", "--overwrite", "--smooth", "off", *options
        )
        self.report = json.loads((self.folder / "r.json").read_text("utf-8"))
        self.warnings = {warning["code"]: warning["message"] for warning in self.report["warnings"]}
        return volumes.read_floats(self.folder / "t.mha")

    def assert_equal_values(self, found, expected):
        self.assertEqual(len(found), len(expected))
        for value, wanted in zip(found, expected):
            self.assertTrue(abs(value - wanted) < 1e-5 or math.isnan(value) and math.isnan(wanted), (value, wanted))

    def test_equals_the_search_over_all_balls(self):
        found = self.measure("--max-pore-size", 0, "--largest-ball", CAP)
        expected = largest_balls(self.indices, self.volume.voxels, SPACING, CAP)
        self.assert_equal_values(found, expected)
        at_maximum = sum(value >= CAP - 1e-6 for value in expected)
        self.assertGreater(at_maximum, 50)
        expected = {"method": "sphere", "largest_ball": CAP, "voxels_at_maximum": at_maximum, "voxels_without_wall": 0}
        self.assertEqual({key: self.report["local_thickness"][key] for key in expected}, expected)
        header, _ = volumes.read_header(self.folder / "t.mha")
        self.assertEqual(header["DimSize"], " ".join(map(str, SIZE)))

    def test_statistics_are_of_the_map(self):
        for method in ("sphere", "wall"):
            for options in ((), ("--largest-ball", CAP), ("--largest-ball", "9vx"), ("--divisions", 3), ("--threads", 1)):
                known = [value for value in self.measure(*options, method=method) if value > 0]
                found = self.report["local_thickness"]
                self.assertAlmostEqual(found["mean"], statistics.fmean(known), delta=1e-4)
                self.assertAlmostEqual(found["standard_deviation"], statistics.pstdev(known), delta=1e-4)
                self.assertAlmostEqual(found["largest"], max(known), delta=1e-6)
                numbers = {key: found[key] for key in ("mean", "standard_deviation", "largest")}
                if not options:
                    expected = numbers
                elif options[0] in ("--divisions", "--threads"):
                    self.assertEqual(numbers, expected)
        table = self.run_program(
            "extract", "in.mha", "out.mha", "--local-thickness", "t.mha", "--html", "p.html", "--overwrite", "--smooth", "off"
        ).stdout
        self.assertRegex(table, rf"local thickness +mean {expected['mean']:.4g}, standard deviation .*, largest .*, in ")
        self.assertIn("largest", (self.folder / "p.html").read_text().split("local thickness")[1])

    def test_no_object_has_no_statistics(self):
        volumes.write_meta(self.folder / "in.mha", volumes.Volume(SIZE, [0] * len(self.volume.voxels), SPACING))
        self.measure()
        self.assertEqual([self.report["local_thickness"][key] for key in ("mean", "standard_deviation", "largest")], [None] * 3)

    def test_without_a_limit_that_matters(self):
        found = self.measure("--max-pore-size", 0)
        largest = 32 * max(SPACING)
        self.assert_equal_values(found, largest_balls(self.indices, self.volume.voxels, SPACING, largest))
        self.assertAlmostEqual(self.report["local_thickness"]["largest_ball"], largest, delta=1e-5)
        self.assertEqual(self.report["local_thickness"]["voxels_at_maximum"], 0)
        self.assertNotIn("beyond_largest_ball", self.warnings)

    def test_a_picture(self):
        flat = volumes.Volume((60, 40), random_blobs((60, 40, 1)), (0.5, 0.8))
        volumes.write_meta(self.folder / "in.mha", flat)
        found = self.measure("--max-pore-size", 0)
        self.assert_equal_values(found, largest_balls(list(flat.indices()), flat.voxels, (0.5, 0.8, 1), 32 * 0.8))

    def test_pores_and_grains_do_not_count(self):
        solid = [60 * all(3 <= i < n - 3 for i, n in zip(index, SIZE)) for index in self.indices]
        noise = {(5, 5, 5), (10, 8, 6), (1, 1, 1), (15, 1, 10)}
        noisy = [60 - value if index in noise else value for index, value in zip(self.indices, solid)]
        self.assertEqual(sum(a != b for a, b in zip(noisy, solid)), len(noise))
        expected = largest_balls(self.indices, solid, SPACING, 38.4)
        volumes.write_meta(self.folder / "in.mha", volumes.Volume(SIZE, noisy, SPACING))
        self.assert_equal_values(self.measure(), expected)

    def test_walls_equal_the_search_over_all_walls(self):
        """With a spacing whose squares are exact, so that pairs under the same angle tie here as in the program."""
        spacing = (0.5, 0.75, 1.25)
        volumes.write_meta(self.folder / "in.mha", volumes.Volume(SIZE, self.volume.voxels, spacing))
        for cap in (3.0, 40.0):
            found = self.measure(
                "--max-pore-size", 0, "--largest-ball", cap, "--thickness-map", "w.mha",
                "--vectors", "v.mha", "--vector-boundary", "background", method=None,
            )  # fmt: skip
            vectors, thickness = (volumes.read_floats(self.folder / name) for name in ("v.mha", "w.mha"))
            expected = thickest_walls(self.indices, self.volume.voxels, spacing, cap, thickness, vectors)
            self.assert_equal_values(found, expected)
            uncovered = sum(map(math.isnan, expected))
            self.assertGreater(uncovered, 0)
            walls = self.report["local_thickness"]
            at_maximum = sum(value == cap for value in expected)
            walls = {key: value for key, value in walls.items() if key not in ("mean", "standard_deviation", "largest")}
        self.assertEqual(walls.pop("voxels"), sum(value > 0 for value in expected))
        self.assertEqual(walls, {"method": "wall", "largest_ball": cap, "voxels_at_maximum": at_maximum, "voxels_without_wall": uncovered})

    def test_walls_on_gray_values(self):
        """A wall whose two faces are between voxels: as the map of its medial cells, not a whole number of voxels."""
        volumes.write_meta(self.folder / "in.mha", volumes.blurred_wall(7))
        options = ("--lower", 1000, "--thickness-map", "w.mha")
        on_gray = {value for value in self.measure(*options, method="wall") if value > 0}
        self.assertLessEqual(on_gray, {value for value in volumes.read_floats(self.folder / "w.mha") if value > 0})
        on_object = {value for value in self.measure(*options, "--sub-voxel=off", method="wall") if value > 0}
        self.assertNotEqual(on_gray, on_object)

    def test_walls_have_the_same_bytes_for_any_division(self):
        self.check_divisions(self.blobs(), "--local-thickness-method", "wall", "--largest-ball", 3)

    def test_walls_on_gray_values_have_the_same_bytes_for_any_division(self):
        self.check_divisions(volumes.blurred_wall(7), "--lower", 1000, "--largest-ball", 6)

    def test_balls_have_the_same_bytes_for_any_division(self):
        self.check_divisions(self.blobs(), "--local-thickness-method", "sphere", "--largest-ball", 6)

    @staticmethod
    def blobs():
        return volumes.Volume((40, 33, 45), random_blobs((40, 33, 45)), SPACING)

    def check_divisions(self, volume, *options):
        volumes.write_meta(self.folder / "in.mha", volume)
        options = (*options, "--distance", "d.mha")
        self.measure("--threads", 1, *options, method=None)
        files = ("out.mha", "t.mha", "d.mha")
        expected = [(self.folder / name).read_bytes() for name in files]
        balls = self.report["local_thickness"]
        self.assertGreater(balls["voxels_at_maximum"], 0)
        for more in (("--threads", 2), ("--divisions", 7), ("--divisions", 44, "--threads", 3), ("--memory", "90M")):
            self.measure(*more, *options, method=None)
            self.assertEqual([(self.folder / name).read_bytes() for name in files], expected, more)
            self.assertEqual(self.report["local_thickness"], balls)
        self.run_program("plan", "in.mha", "out.mha", "job", "--divisions", 3, "--local-thickness", "t.mha", "--smooth", "off", "--report", "r.json", "--overwrite", *options)
        for cluster in (2, 0, 1):
            self.run_program("work", "job", "--clusters", cluster)
        self.run_program("finalize", "job")
        self.assertEqual([(self.folder / name).read_bytes() for name in files], expected)
        self.assertEqual(json.loads((self.folder / "r.json").read_text("utf-8"))["local_thickness"], balls)

    def test_a_share_at_the_maximum_is_a_warning(self):
        self.measure("--largest-ball", 2)
        message = self.warnings["beyond_largest_ball"]
        self.assertRegex(message, r"^\d+ % of the object has the thickness of the largest ball, 2, and may be thicker")

    def test_errors(self):
        local = ("--local-thickness", "t.mha")
        for words, options in (
            (["--largest-ball", "0", "greater than 0"], (*local, "--largest-ball", 0)),
            (["--largest-ball", "180", "256 voxels, 179.2"], (*local, "--largest-ball", 180)),
            (["largest ball", "none is asked for"], ("--largest-ball", 5)),
            (["--local-thickness-method", "no effect", "--local-thickness"], ("--local-thickness-method", "wall")),
            (["--local-thickness-method", "'ball'", "wall"], (*local, "--local-thickness-method", "ball")),
            (["labels of several objects", "a local thickness"], (*local, "--labels", "all")),
            (["labels of several objects", "an importance"], ("--importance", "i.mha", "--labels", "all")),
        ):
            self.assert_fails(USAGE, words, "extract", "in.mha", "o.mha", *options)
            self.assertFalse((self.folder / "o.mha").exists())


if __name__ == "__main__":
    unittest.main()
