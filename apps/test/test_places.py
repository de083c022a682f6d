# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Places with too thin or too thick walls: the same as by a flood fill over the thickness map, for any division."""

import base64
import itertools
import json
import math
import pathlib
import random
import re
import shutil
import subprocess
import unittest

import jobs
import volumes
from places import find_places, read_places
from program import PROGRAM, USAGE, ProgramTestCase
from test_preview import read_png

TOO_THIN = 5
NOT_MEASURED = 6
ENGINE = pathlib.Path(__file__).parents[3] / "shared/data/engine.mha"
AXES = "xyz"


def random_part(seed, size=(44, 38, 36), spacing=(0.5, 0.75, 0.6)):
    """Plates of many thicknesses and directions with holes and dents."""
    noise = random.Random(seed)
    volume = volumes.Volume(size, [], spacing[: len(size)])
    plates = []
    for _ in range(7):
        normal = [noise.gauss(0, 1) for _ in size]
        length = sum(n * n for n in normal) ** 0.5
        center = [noise.uniform(0.2, 0.8) * n for n in size]
        plates.append(([n / length for n in normal], center, noise.uniform(1.0, 3.5)))
    dents = [([noise.uniform(0, n) for n in size], noise.uniform(3, 7)) for _ in range(12)]

    def value(*index):
        for normal, center, half in plates:
            if abs(sum(n * (i - c) for n, i, c in zip(normal, index, center))) < half:
                return 0 if any(sum((i - c) ** 2 for i, c in zip(index, dent)) < r * r for dent, r in dents[:6]) else 1
        return 1 if any(sum((i - c) ** 2 for i, c in zip(index, dent)) < r * r for dent, r in dents[6:]) else 0

    volume.voxels = [value(*index[: len(size)]) for index in volume.indices()]
    return volume


def keep_all(limits):
    """Limits of places, with the area of the smallest one."""
    return f"{limits},0" if "," in str(limits) else f"{limits},,0"


def pitted_wall(size=(96, 96, 28), lower=8, upper=14, depth=2, radius=7):
    """A wall of six voxels with round pits from one side, and the places of these."""
    pits = [(x, y) for y in (20, 48, 76) for x in (20, 48, 76)]

    def value(x, y, z):
        top = upper - depth if any(math.dist((x, y), pit) < radius for pit in pits) else upper
        return 1 if 4 <= x < size[0] - 4 and 4 <= y < size[1] - 4 and lower <= z < top else 0

    volume = volumes.Volume(size, [])
    volume.voxels = [value(*index) for index in volume.indices()]
    return volume, pits


def flip_surface(part, seed):
    """A tenth of the voxels with another value among their 26 neighbors changes sides."""
    noise = random.Random(seed)
    width, height, depth = part.size
    steps = [(z * height + y) * width + x for x, y, z in itertools.product((-1, 0, 1), repeat=3)]

    def is_beside(at, x, y, z):
        if not (0 < x < width - 1 and 0 < y < height - 1 and 0 < z < depth - 1):
            return False
        return len({part.voxels[at + step] for step in steps}) == 2

    flipped = volumes.Volume(part.size, [])
    flipped.voxels = [
        value ^ (is_beside(at, *index) and noise.random() < 0.1)
        for at, (value, index) in enumerate(zip(part.voxels, part.indices()))
    ]
    return flipped


class PlacesTest(ProgramTestCase):
    def places(self, *arguments, source="in.mha", table="p.csv", thickness=3):
        self.extract(source, "l.mha", "--places", table, "--overwrite", *arguments, thickness=thickness)
        return read_places(self.folder / table)

    def assert_same_places(self, rows, expected, geometry):
        """Rows of one kind are these places, the largest first."""
        axes = AXES[: len(geometry.size)]
        order = [(-row["area_beyond_limit"], *(row["index_" + axis] for axis in axes[::-1])) for row in rows]
        self.assertEqual(order, sorted(order))
        self.assertEqual([row["place"] for row in rows], list(range(1, len(rows) + 1)))
        by_index = sorted(rows, key=lambda row: [row["index_" + axis] for axis in axes[::-1]])
        self.assertEqual(len(by_index), len(expected))
        for row, place in zip(by_index, expected):
            for name in ("index", "first", "last"):
                self.assertEqual([row[f"{name}_{axis}"] for axis in axes], list(place[name][: len(axes)]), name)
            self.assertEqual(row["cells"], place["cells"])
            self.assertEqual((row["minimum"], row["maximum"]), (place["minimum"], place["maximum"]))
            self.assertAlmostEqual(row["mean"], place["mean"], delta=2e-5)
            for axis, spacing in zip(axes, geometry.spacing):
                self.assertAlmostEqual(row[axis], (row["index_" + axis] + 0.5) * spacing, places=9)

    def assert_sides(self, row, part, spacing):
        """Two voxels of background, each the nearest one of a corner of the cell."""
        points = [[row[f"side_{side}_{axis}"] for axis in AXES] for side in "ab"]
        self.assertNotEqual(*points)
        width, height, _ = part.size
        cell = [row[f"index_{axis}"] for axis in AXES]

        def is_background(index):
            inside = all(0 <= i < n for i, n in zip(index, part.size))
            return inside and part.voxels[(index[2] * height + index[1]) * width + index[0]] == 0

        def squared(a, b):
            return sum(((i - j) * s) ** 2 for i, j, s in zip(a, b, spacing))

        around = [index for index in itertools.product(*(range(c - 6, c + 8) for c in cell)) if is_background(index)]
        corners = list(itertools.product(*((c, c + 1) for c in cell)))
        for point in points:
            index = [round(p / s) for p, s in zip(point, part.spacing)]
            self.assertTrue(all(abs(i * s - p) < 1e-9 for i, s, p in zip(index, part.spacing, point)))
            self.assertTrue(is_background(index))
            nearest = (min(squared(corner, other) for other in around) for corner in corners)
            self.assertTrue(any(squared(corner, index) <= n + 1e-9 for corner, n in zip(corners, nearest)), row)
        voxels = [cell, [c + 1 for c in cell], *([round(p / s) for p, s in zip(point, part.spacing)] for point in points)]
        outermost = any(i in (0, n - 1) for voxel in voxels for i, n in zip(voxel, part.size))
        self.assertEqual(row["at_edge"], int(outermost))

    def test_places_are_those_of_the_map(self):
        found = 0
        for seed, thickness in ((1, 3), (2, "3vx"), (3, "auto")):
            part = random_part(seed)
            volumes.write_meta(self.folder / "in.mha", part)
            for limits in (("2.0,2.0", "2.6,2.6"), ("1.7,2.4", "3,2.5"), ("2.4", "2.5"), ("0.6", "9"), ("99", "0.01")):
                arguments = ["--thin-below", keep_all(limits[0]), "--thick-above", keep_all(limits[1])]
                rows = self.places("--thickness-map", "t.mha", "--report", "r.json", *arguments, thickness=thickness)
                values = volumes.read_floats(self.folder / "t.mha")
                report = json.loads((self.folder / "r.json").read_text())
                for kind, text, factor in (("thin", limits[0], 1.125), ("thick", limits[1], 0.875)):
                    limit, *grow = map(float, text.split(","))
                    expected = find_places(values, part.size, kind, limit, *(grow or [limit * factor]))
                    own = [row for row in rows if row["kind"] == kind]
                    self.assert_same_places(own, expected, part)
                    if seed < 3:  # without pores that are taken for object
                        for row in own[:4]:
                            self.assert_sides(row, part, part.spacing)
                    told = report["places"][kind]
                    self.assertEqual((told["number"], told["smaller"]), (len(expected), 0))
                    self.assertEqual(told["cells"], sum(place["cells"] for place in expected))
                    self.assertAlmostEqual(told["area"], sum(row["area"] for row in own), delta=1e-6)
                    self.assertEqual([place["cells"] for place in told["places"]], [row["cells"] for row in own[:100]])
                    found += len(expected)
                    if limit in (99, 0.01):  # all cells that are measured
                        self.assertEqual(told["cells"], report["thickness"]["cells"])
                        self.assertAlmostEqual(told["area"], report["thickness"]["area"], delta=1e-6)
        self.assertGreater(found, 200)

    def test_small_places_are_left_out(self):
        volumes.write_meta(self.folder / "in.mha", random_part(4))
        every = self.places("--thin-below", "2.2,,0")
        areas = [row["area_beyond_limit"] for row in every]
        self.assertTrue(all(row["area_beyond_limit"] <= row["area"] for row in every))
        self.assertTrue(any(row["area_beyond_limit"] < row["area"] for row in every))
        self.assertGreater(len(set(areas)), 5)
        for smallest in (areas[2], areas[-1], areas[0] * 1.001):
            rows = self.places("--thin-below", f"2.2,,{smallest!r}", "--report", "r.json")
            self.assertEqual(rows, [row for row in every if row["area_beyond_limit"] >= smallest])
            told = json.loads((self.folder / "r.json").read_text())["places"]
            self.assertEqual((told["thin"]["number"], told["thin"]["smaller"]), (len(rows), len(every) - len(rows)))
            self.assertIsNone(told["thick"])
            both = self.places("--thin-below", "2.2,,0", "--thick-above", f"2.6,,{smallest!r}")
            self.assertEqual([row for row in both if row["kind"] == "thin"], every)
            self.assertTrue(all(row["area_beyond_limit"] >= smallest for row in both if row["kind"] == "thick"))
        for area, least in (("10vx", 10 * 0.5**2), ("3MM", 3)):
            self.assertEqual(self.places("--thin-below", "2.2,," + area), [row for row in every if row["area_beyond_limit"] >= least])
        faces = 10 * 0.75 * 0.6
        self.assertEqual(self.places("--thin-below", 2.2), [row for row in every if row["area_beyond_limit"] >= faces])

    def test_no_division_changes_a_byte(self):
        arguments = ["--thin-below", "2.2,,0", "--thick-above", "2.6,,0"]
        for seed in (5, 6):
            volumes.write_meta(self.folder / "in.mha", random_part(seed))
            self.places(*arguments)
            expected = (self.folder / "p.csv").read_bytes()
            self.assertGreater(expected.count(b"\n"), 15)
            for run in (
                ["--divisions", 2], ["--divisions", 5, "--threads", 2], ["--divisions", 36], ["--threads", 1],
                ["--memory", "40M", "--threads", 1], ["--mesh", "m.vtp", "--divisions", 3], ["--html", "h.html"],
            ):  # fmt: skip
                self.places(*arguments, *run)
                self.assertEqual((self.folder / "p.csv").read_bytes(), expected, run)

    def test_pieces_of_rows(self):
        volumes.write_meta(self.folder / "in.mha", random_part(7, (40, 300, 40)))
        arguments = ["--thin-below", "2.2,,0"]
        self.places(*arguments)
        expected = (self.folder / "p.csv").read_bytes()
        self.extract("in.mha", "x.zarr", "--overwrite")
        self.extract("x.zarr", "y.zarr", "--thin-below", "2.2,,0", "--places", "a.csv", thickness=1)
        whole = (self.folder / "a.csv").read_bytes()
        for run in (["--memory", "40M", "--threads", 1], ["--divisions", 3]):
            self.extract("x.zarr", "z.zarr", *arguments, "--places", "b.csv", "--overwrite", *run, thickness=1)
            self.assertEqual((self.folder / "b.csv").read_bytes(), whole, run)
        self.assertGreater(expected.count(b"\n"), 3)

    def test_images_of_two_dimensions(self):
        part = random_part(8, (120, 90), (0.5, 0.75))
        volumes.write_meta(self.folder / "in.mha", part)
        rows = self.places("--thin-below", "2,,0", "--thickness-map", "t.mha")
        values = volumes.read_floats(self.folder / "t.mha")
        expected = find_places(values, part.size, "thin", 2, 2.25)
        self.assertGreater(len(expected), 3)
        self.assert_same_places(rows, expected, part)
        self.assertNotIn("z", rows[0])
        before = (self.folder / "p.csv").read_bytes()
        self.places("--thin-below", "2,,0", "--divisions", 9)
        self.assertEqual((self.folder / "p.csv").read_bytes(), before)

    def test_thin_places_may_fail(self):
        volumes.write_meta(self.folder / "in.mha", random_part(9))
        for limit, status in ((2.2, TOO_THIN), (0.01, 0)):
            command = ["in.mha", "l.mha", "--thin-below", limit, "--fail-if-thin", "--overwrite", "--report", "r.json"]
            result = self.run_failing("extract", *command, "--thickness", 3, status=status)
            self.assertIn("thin places", result)
            self.assertEqual(json.loads((self.folder / "r.json").read_text())["places"]["thin"]["number"] > 0, status == 5)
        self.run_failing(
            "extract", "in.mha", "m.mha", "--thin-below", 2.2, "--fail-if-thin", "--resume", status=TOO_THIN
        )

    def test_area_beyond_the_limit_is_that_of_its_cells(self):
        volumes.write_meta(self.folder / "in.mha", random_part(13))
        grown = self.places("--thin-below", "2.2,2.6,0")
        strict = self.places("--thin-below", "2.2,2.2,0")
        self.assertAlmostEqual(
            sum(row["area_beyond_limit"] for row in grown), sum(row["area"] for row in strict), delta=1e-6
        )
        self.assertEqual([row["area"] for row in strict], [row["area_beyond_limit"] for row in strict])

    def test_a_wall_of_exactly_the_limit_is_neither_thin_nor_thick(self):
        for spacing in (0.0195, 0.1, 0.2, 0.25, 0.3, 0.35, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.1, 1.2):
            for layers in range(3, 9):
                plate = volumes.Volume((24, 24, 16), [], (spacing,) * 3)
                plate.voxels = [
                    1 if 2 <= x < 22 and 2 <= y < 22 and 4 <= z < 4 + layers else 0 for x, y, z in plate.indices()
                ]
                volumes.write_meta(self.folder / "in.mha", plate)
                limit = f"{layers * spacing:.10g}"
                rows = self.places("--thin-below", keep_all(limit), "--thick-above", keep_all(limit))
                self.assertEqual(rows, [], (spacing, layers))

    def test_without_evidence_there_is_no_verdict(self):
        ball = volumes.Volume((30, 30, 30), [])
        ball.voxels = [1 if math.dist(index, (15, 15, 15)) < 10 else 0 for index in ball.indices()]
        dust = volumes.Volume((30, 30, 30), [])
        dust.voxels = [1 if all(9 < i < 12 for i in index) else 0 for index in dust.indices()]
        empty = volumes.Volume((20, 20, 20), [0] * 8000)
        full = volumes.Volume((20, 20, 20), [1] * 8000)
        command = ["in.mha", "l.mha", "--thin-below", 2, "--fail-if-thin", "--overwrite", "--quiet"]
        for part in (ball, dust, empty, full):
            volumes.write_meta(self.folder / "in.mha", part)
            for options in ([], ["--thickness", 3], ["--resume"], ["--thickness-map", "t.mha"]):
                error = self.read_errors("extract", *command, *options, status=NOT_MEASURED)
                self.assertIn("no verdict on thin walls", error)
            self.run_failing("extract", *command, "--dry-run", status=0)
        labels = volumes.Volume((60, 30, 30), [])
        labels.voxels = [
            2 if math.dist((x, y, z), (15, 15, 15)) < 10 else 1 if 34 <= x < 56 and 4 <= y < 26 and 10 <= z < 16 else 0
            for x, y, z in labels.indices()
        ]
        volumes.write_meta(self.folder / "in.mha", labels)
        self.run_failing("extract", *command, "--label", 1, status=0)
        self.run_failing("extract", *command, "--label", 2, status=NOT_MEASURED)

    def test_a_label_that_no_voxel_has_is_a_mistake(self):
        volumes.write_meta(self.folder / "in.mha", volumes.box_with_plate())
        for command in (["extract", "in.mha", "o.mha"], ["mesh", "in.mha", "o.vtp"], ["distance", "in.mha", "o.mha"],
                        ["surface", "in.mha", "o.ply"]):  # fmt: skip
            self.assert_fails(USAGE, ["in.mha", "no voxel has the label 9"], *command, "--label", 9)
            self.assertFalse(list(self.folder.glob("o.*")), command)

    def read_errors(self, *arguments, status):
        result = subprocess.run(
            [PROGRAM, *map(str, arguments)], capture_output=True, text=True, cwd=self.folder, check=False
        )
        self.assertEqual(result.returncode, status, f"{arguments}\n{result.stdout}{result.stderr}")
        return result.stderr

    def run_failing(self, *arguments, status):
        """Prints its table also when it ends with the status for thin places."""
        result = subprocess.run(
            [PROGRAM, *map(str, arguments)], capture_output=True, text=True, cwd=self.folder, check=False
        )
        self.assertEqual(result.returncode, status, f"{arguments}\n{result.stdout}{result.stderr}")
        return result.stdout

    def test_noise_hides_no_place(self):
        part, pits = pitted_wall()
        volumes.write_meta(self.folder / "in.mha", part)
        clean = self.places("--thin-below", "5vx", thickness="auto")
        self.assertEqual(len(clean), len(pits))
        for seed in range(3):
            volumes.write_meta(self.folder / "noisy.mha", flip_surface(part, seed))
            options = ["--thin-below", "5vx", "--smooth", "auto", "--report", "r.json"]
            noisy = self.places(*options, source="noisy.mha", thickness="auto")
            self.assertTrue(json.loads((self.folder / "r.json").read_text())["smoothed"])
            for x, y in pits:
                over = [row for row in noisy if math.dist((row["index_x"], row["index_y"]), (x, y)) < 6]
                self.assertEqual(len(over), 1, (seed, x, y, noisy))
            self.assertEqual(len(noisy), len(pits), seed)
            # The noise matters.
            rough = self.places("--thin-below", "5vx", "--smooth", "off", source="noisy.mha", thickness="auto")
            areas = [sum(row["area"] for row in rows) for rows in (rough, noisy)]
            self.assertGreater(areas[0], 1.2 * areas[1], seed)

    def test_page_has_the_first_places(self):
        volumes.write_meta(self.folder / "in.mha", random_part(1))
        rows = self.places("--thin-below", 2.2, "--html", "h.html")
        page = (self.folder / "h.html").read_text()
        self.assertIn("places below 2.2</h2>", page)
        self.assertNotRegex(page.split("<script")[0], "places? above")
        self.assertEqual(page.count('<svg class="section"'), min(len(rows), 20))
        for row in rows[:20]:
            self.assertIn(f">{row['index_x']}, {row['index_y']}, {row['index_z']}<", page)

    def test_sections_show_the_wall_between_its_marks(self):
        """A plate of 9 voxels, 5 in its middle, turned in space: a wall in the picture, with the marks in its ends."""
        volume = volumes.Volume((40, 36, 32), [], (0.5, 0.5, 0.5))
        volume.voxels = [
            100 if abs(x - 18) <= (2 if 12 <= y < 24 and 10 <= z < 22 else 4) and 4 <= y < 32 and 4 <= z < 28 else 10
            for x, y, z in volume.indices()
        ]
        volumes.write_meta(self.folder / "in.mha", volume, TransformMatrix="0 1 0 0 0 1 1 0 0", Offset="7 8 9")
        pages = []
        for options in (["--threads", 1], ["--divisions", 5]):
            rows = self.places("--lower", 50, "--thin-below", 3, "--html", "h.html", *options, thickness="auto")
            pages.append(re.findall('<svg class="section".*?</svg>.*?wide', (self.folder / "h.html").read_text()))
        self.assertEqual(*pages)
        section = pages[0][0]
        (self.folder / "s.png").write_bytes(base64.b64decode(re.search("base64,([^\"]*)", section)[1]))
        picture = read_png(self.folder / "s.png")
        step = float(re.search(r"([\d.]+) wide", section)[1]) / len(picture)
        middle = [color[0] for color in picture[len(picture) // 2]]
        wall = [column for column, shade in enumerate(middle) if shade > 127]
        self.assertEqual((min(middle), max(middle)), (0, 255))
        self.assertEqual(wall, list(range(wall[0], wall[-1] + 1)), "one wall")
        marks = [float(number) for number in re.findall(r'x[12]="([\d.]+)"', section)]
        sides = [[rows[0][f"side_{side}_{axis}"] for axis in AXES] for side in "ab"]
        self.assertAlmostEqual((marks[1] - marks[0]) * step, math.dist(*sides), delta=0.02)
        for mark, end in zip(marks, (wall[0], wall[-1] + 1)):
            self.assertAlmostEqual(mark * step, end * step, delta=0.3, msg="half a voxel, as they are in voxels beside the wall")

    def test_wrong_values_are_refused(self):
        volumes.write_meta(self.folder / "in.mha", volumes.box_with_plate())
        for parts, *arguments in (
            (["--thin-below", "0", "greater than 0"], "--thin-below", 0),
            (["--thick-above", "-1"], "--thick-above", -1),
            (["--thin-below", "inf"], "--thin-below", "inf"),
            (["--thin-below", "'x' is not a finite number"], "--thin-below", "x"),
            (["--thin-below", "not one or two lengths and an area"], "--thin-below", "1,2,3,4"),
            (["second length", "1.5", "less", "2"], "--thin-below", "2,1.5"),
            (["second length", "3", "greater", "2"], "--thick-above", "2,3"),
            (["--thin-below", "-1"], "--thin-below", "2,,-1"),
            (["--thick-above", "nan"], "--thick-above", "2,1,nan"),
            (["--thin-below", "''"], "--thin-below", "2,"),
            (["--thin-below", "''"], "--thin-below", "2,3,"),
            (["--places", "--thin-below"], "--places", "p.csv"),
            (["--fail-if-thin", "--thin-below"], "--fail-if-thin", "--thick-above", 3),
            (["p.txt", ".csv"], "--thin-below", 2, "--places", "p.txt"),
            (["thin or thick places", "--label"], "--thin-below", 2, "--labels", "all"),
        ):
            self.assert_fails(USAGE, parts, "extract", "in.mha", "out.mha", *arguments)

    @unittest.skipUnless(ENGINE.exists(), "the engine volume is not here")
    def test_engine_has_thin_places(self):
        arguments = ["--lower", 72, "--thin-below", "3.5,4.5", "--thickness-map", "t.mha"]
        rows = self.places(*arguments, "--sub-voxel=off", source=ENGINE)
        header, _ = volumes.read_header(self.folder / "t.mha")
        size = [int(number) for number in header["DimSize"].split()]
        values = volumes.read_floats(self.folder / "t.mha")
        expected = {place["index"]: place for place in find_places(values, size, "thin", 3.5, 4.5)}
        self.assertGreater(len(rows), 5)
        for row in rows:
            index = tuple(row[f"index_{axis}"] for axis in AXES)
            place = expected[index]
            self.assertEqual((row["cells"], row["minimum"]), (place["cells"], place["minimum"]))
            self.assertLess(row["minimum"], 3.5)
            self.assertLess(row["maximum"], 4.5)


class PlacesOfJobsTest(jobs.JobTestCase):
    def test_clusters_find_the_same_places(self):
        for number, seed in enumerate((10, 11)):
            volumes.write_meta(self.folder / "in.mha", random_part(seed), compressed=number == 1)
            options = "--thickness 3 --thin-below 2.2,,0 --thick-above 2.6,,0 --places p.csv".split()
            options += ["--report", "r.json", "--html", "h.html"]
            expected = self.expect("extract", "../in.mha", "out.mha", *options)
            self.assertGreater(expected["p.csv"].count(b"\n"), 15)
            for divisions in (3, 36, 7):
                self.in_target("plan", "../in.mha", "out.mha", "job", *options, "--divisions", divisions)
                self.in_target("work", "job", "--clusters", "1-2", "--threads", 1)
                self.in_target("work", "job")
                self.in_target("finalize", "job")
                found = jobs.results(self.target)
                self.assertEqual(found["p.csv"], expected["p.csv"])
                self.assertEqual(found["r.json"]["places"], expected["r.json"]["places"])
                self.assertTrue(found["h.html"] == expected["h.html"], "sections are those of one run")
                self.clear_target()
            shutil.rmtree(self.folder / "expected")

    def test_a_job_may_fail_for_thin_places(self):
        volumes.write_meta(self.folder / "in.mha", random_part(12))
        options = ["--thickness", 3, "--thin-below", 2.2, "--fail-if-thin", "--divisions", 3]
        self.in_target("plan", "../in.mha", "out.mha", "job", *options)
        self.in_target("work", "job")
        for _ in range(2):  # also when it was finished before
            result = subprocess.run(
                [PROGRAM, "finalize", "job"], cwd=self.target, capture_output=True, text=True, check=False
            )
            self.assertEqual((result.returncode, result.stderr), (TOO_THIN, ""))


if __name__ == "__main__":
    unittest.main()
