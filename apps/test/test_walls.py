# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Walls of known parts and the seams where they meet: their number, tables and volume, for any run."""

import csv
import json
import math
import random
import re
import struct
import unittest

import volumes
from program import REFUSED, USAGE, ProgramTestCase

SIZE = (58, 56, 54)
TURN = (0.4, 0.7, 0.59160797831)  # the axis of a rotation, of length 1


def turned(point, degrees):
    """The point, rotated around the axis."""
    cosine, sine = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    x, y, z = point
    a, b, c = TURN
    along = (1 - cosine) * (a * x + b * y + c * z)
    cross = (b * z - c * y, c * x - a * z, a * y - b * x)
    return tuple(cosine * p + sine * q + along * r for p, q, r in zip(point, cross, TURN))


def part(is_inside, degrees=0.0, flips=0.0, seed=1):
    """Voxels of a part, and the share of voxels at its boundary that noise has flipped."""
    draw = random.Random(seed)
    volume = volumes.Volume(SIZE, [])
    centers = [tuple(i - (n - 1) / 2 + 0.1 for i, n in zip(index, SIZE)) for index in volume.indices()]
    clean = [is_inside(*turned(center, degrees)) for center in centers]
    steps = (1, SIZE[0], SIZE[0] * SIZE[1])
    rough = list(clean)
    if flips > 0:
        for i, value in enumerate(clean):
            near = (clean[k] for step in steps for k in (i - step, i + step) if 0 <= k < len(clean))
            if any(other != value for other in near) and draw.random() < flips:
                rough[i] = not value
    volume.voxels = [1 if value else 0 for value in rough]
    return volume


def is_in(point, *sides):
    return all(low <= value <= high for value, (low, high) in zip(point, sides))


def tee(x, y, z):
    return is_in((x, y, z), (-20, 20), (-16, 16), (-12, -8)) or is_in((x, y, z), (-2, 2), (-16, 16), (-10, 12))


def beam(x, y, z):
    return abs(y) < 14 and (abs(x) < 15 and 11 < abs(z) < 15 or abs(x) < 2 and abs(z) < 13)


def box(x, y, z):
    return max(abs(x) - 17, abs(y) - 16, abs(z) - 15) < 0 and max(abs(x) - 13, abs(y) - 12, abs(z) - 11) > 0


def bent(x, y, z):
    """A plate that turns by a right angle with a radius of 10."""
    x, z = x + 5, z + 5
    radius = math.hypot(x, z) if x < 0 and z < 0 else -x if z >= 0 else -z if x >= 0 else 99
    return abs(y) < 15 and abs(radius - 10) < 2 and max(x, z) < 17


def rib(x, y, z):
    return is_in((x, y, z), (-20, 20), (-16, 16), (-2, 2)) or is_in((x, y, z), (-6, -2), (-16, 16), (0, 14))


PARTS = {tee: (3, 1), beam: (5, 2), box: (6, 12), bent: (1, 0), rib: (3, 1)}
OUTPUTS = ("--walls", "w.mha", "--wall-table", "w.csv", "--seam-table", "s.csv", "--report", "r.json")


class WallsTest(ProgramTestCase):
    def rows(self, name):
        with open(self.folder / name, newline="") as file:
            return list(csv.DictReader(file))

    def walls(self, *arguments):
        self.run_program("extract", "in.mha", *OUTPUTS, "--label", "1", "--overwrite", "--quiet", *arguments)
        self.report = json.loads((self.folder / "r.json").read_text())["walls"]
        return self.rows("w.csv"), self.rows("s.csv")

    def check(self, volume, expected, what):
        volumes.write_meta(self.folder / "in.mha", volume)
        walls, seams = self.walls()
        self.assertEqual((len(walls), len(seams)), expected, what)
        return walls, seams

    def test_known_parts(self):
        for shape, expected in PARTS.items():
            for degrees in (0, 33):
                self.check(part(shape, degrees), expected, (shape.__name__, degrees))

    def test_noisy_parts(self):
        for seed, (shape, expected) in enumerate(PARTS.items()):
            self.check(part(shape, 20 + 30 * seed, 0.1, seed), expected, shape.__name__)

    def test_tables_and_volume_agree(self):
        walls, seams = self.check(part(tee), (3, 1), "T")
        data = volumes.read_data(self.folder / "w.mha")
        numbers = struct.unpack(f"<{len(data) // 4}I", data)
        self.assertEqual([numbers.count(k + 1) for k in range(3)], [int(row["cells"]) for row in walls])
        self.assertEqual(set(numbers), {0, 1, 2, 3})
        areas = [float(row["area"]) for row in walls]
        self.assertEqual(areas, sorted(areas, reverse=True))
        for row in walls:
            thickness = [float(row[f"thickness_{key}"]) for key in ("minimum", "mean", "maximum")]
            self.assertEqual(thickness, sorted(thickness))
            self.assertAlmostEqual(thickness[1], 4, delta=0.3)
            self.assertEqual(len(row["neighbors"].split()), 2)
        # The web is along z, the flange along x.
        self.assertAlmostEqual(max(abs(float(row["normal_x"])) for row in walls), 1, delta=0.01)
        seam, = seams
        self.assertEqual(seam["walls"], "1 2 3")
        self.assertAlmostEqual(float(seam["length"]), 31, delta=3)
        for angle, known in zip(sorted(map(float, seam["angles"].split())), (90, 90, 180)):
            self.assertAlmostEqual(angle, known, delta=12)
        self.assertEqual(self.report["number_of_walls"], 3)
        self.assertEqual(self.report["walls"][2]["cells"], int(walls[2]["cells"]))
        self.assertEqual(self.report["seams"][0]["walls"], [1, 2, 3])

    def test_any_run_has_the_same_bytes(self):
        volume = part(beam, 25, 0.05)
        volume.spacing = (0.5, 0.5, 0.5)
        volumes.write_meta(self.folder / "in.mha", volume)
        self.walls()
        names = ("w.mha", "w.csv", "s.csv")
        known = [(self.folder / name).read_bytes() for name in names]
        for arguments in (
            ("--divisions", "7"), ("--threads", "1"), ("--memory", "64M"), ("labels.mha", "--mesh", "m.ply", "--vectors", "v.mha"),
        ):  # fmt: skip
            self.walls(*arguments)
            self.assertEqual([(self.folder / name).read_bytes() for name in names], known, arguments)
        self.run_program("extract", "in.mha", "--label", "1", "--wall-table", "alone.csv", "--quiet")
        self.assertEqual((self.folder / "alone.csv").read_bytes(), known[1])

    def test_page_has_a_row_for_each_wall(self):
        walls, _ = self.check(part(beam), (5, 2), "I-beam")
        for options, expected in ((("--wall-table", "w.csv"), walls), ((), [])):
            self.run_program("extract", "in.mha", "--label", "1", "--html", "p.html", "--overwrite", "--quiet", *options)
            page = (self.folder / "p.html").read_text(encoding="utf-8")
            rows = [re.findall(r"<td[^>]*>(.*?)</td>", row) for row in re.findall(r'<tr class="wall">(.*?)</tr>', page)]
            self.assertEqual("<h2>Walls</h2>" in page, bool(expected))
            self.assertEqual([row[0] for row in rows], [wall["wall"] for wall in expected])
            for row, wall in zip(rows, expected):
                for cell, name in zip(row[1:5], ("area", "thickness_mean", "thickness_minimum", "thickness_maximum")):
                    self.assertAlmostEqual(float(cell), float(wall[name]), delta=0.01 * float(wall[name]))
                self.assertEqual(re.findall(r"\d+", row[7]), wall["neighbors"].split())

    def test_nothing_has_no_walls(self):
        volumes.write_meta(self.folder / "in.mha", part(lambda x, y, z: False))
        self.run_program("extract", "in.mha", *OUTPUTS, "--lower", "1", "--quiet")
        self.report = json.loads((self.folder / "r.json").read_text())["walls"]
        self.assertEqual((self.rows("w.csv"), self.rows("s.csv")), ([], []))
        self.assertEqual(self.report, {"number_of_walls": 0, "number_of_seams": 0, "walls": [], "seams": []})
        self.assertFalse(any(volumes.read_data(self.folder / "w.mha")))

    def test_errors(self):
        volumes.write_meta(self.folder / "in.mha", part(tee))
        for words, arguments in (
            (["labels of several objects", "walls"], ("--walls", "w.mha", "--labels", "all")),
            (["w.txt", "table of walls", ".csv"], ("--wall-table", "w.txt")),
            (["s.txt", "table of seams", ".csv"], ("--seam-table", "s.txt")),
            (["w.xyz"], ("--walls", "w.xyz")),
        ):
            self.assert_fails(USAGE, words, "extract", "in.mha", *arguments)
        self.assert_fails(REFUSED, ["walls", "clusters"], "plan", "in.mha", "o.mha", "job", "--walls", "w.mha")
        volumes.write_meta(self.folder / "flat.mha", volumes.Volume((9, 9), [1] * 81))
        self.assert_fails(USAGE, ["2 dimensions", "sheet of walls"], "extract", "flat.mha", "--walls", "w.mha")


if __name__ == "__main__":
    unittest.main()
