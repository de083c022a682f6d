# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The view of the page: its points are those of the cells, any division makes the same, and a browser shows it."""

import base64
import json
import math
import pathlib
import re
import shutil
import struct
import subprocess
import unittest
import zlib

import volumes
from interpreters import python_with
from jobs import JobTestCase
from program import ProgramTestCase
from test_walls import part, tee

RUN = re.compile(r'<section id="run">.*?</section>', re.DOTALL)
ENGINE = pathlib.Path(__file__).parents[3] / "shared/data/engine.mha"
BUDGET = 65536


def read_data(page):
    """What the page says about its points, and their bytes; None where it has no view."""
    data = re.search(r'<script type="text/plain" id="view-data">(.*?)</script>', page)
    points = re.search(r'<script type="text/plain" id="view-points">(.*?)</script>', page)
    return (json.loads(data[1]), base64.b64decode(points[1], validate=True)) if data else None


def decode_part(page):
    """Size of an edge, and the share of object by blocks in 15ths, as the page documents its bytes."""
    part = read_data(page)[0]["part"]
    octets = iter(base64.b64decode(re.search(r'id="view-part">(.*?)</script>', page)[1], validate=True))
    shares = []
    for value in octets:
        number, factor = value & 127, 128
        while value >= 128:
            value = next(octets)
            number, factor = number + (value & 127) * factor, 128 * factor
        shares += [number % 16] * (number // 16 + 1)
    width, height, depth = part["blocks"]
    assert len(shares) == width * height * depth
    return part["edge"], {(at % width, at // width % height, at // (width * height)): share for at, share in enumerate(shares)}


def count_faces(shares):
    """Between inside and outside."""
    inside = {block for block, share in shares.items() if share >= 8}
    steps = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    return sum((x + i, y + j, z + k) not in inside for x, y, z in inside for i, j, k in steps)


def decode_points(data, octets):
    """Rows of block, place in the block in 256ths and code, as the page documents its bytes; importance and wall, if it has them."""
    values = iter(octets)

    def number():
        total, factor = 0, 1
        for value in values:
            total += (value & 127) * factor
            factor *= 128
            if value < 128:
                return total
        raise AssertionError("the bytes end too soon")

    key, rows = 0, []
    width, height, _ = data["blocks"]
    for _ in range(data["points"]):
        key += number()
        block = (key % width, key // width % height, key // width // height)
        places = tuple(next(values) for _ in range(3)) if data["edge"] > 1 else (128, 128, 128)
        rows.append((block, places, *(number() for _ in range(1 + (data["importance"][1] > 0) + ("walls" in data)))))
    assert next(values, None) is None, "bytes are left"
    return rows


def group_cells(cells, edge):
    """Means of cells by blocks."""
    blocks = {}
    for cell in cells:
        blocks.setdefault(tuple(index // edge for index in cell), []).append(cell)
    return {block: [sum(axis) / len(members) for axis in zip(*members)] for block, members in blocks.items()}


def place_in_block(mean, block, edge):
    """Of the middle of a cell, in 256ths."""
    return int((mean - block * edge + 0.5) / edge * 256)


class PageCase(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.volume = volumes.box_with_plate(size=(60, 50, 40))
        volumes.write_meta(self.folder / "in.mha", self.volume)

    def page(self, *arguments, source="in.mha", thickness=3):
        self.extract(source, "out.mha", "--html", "r.html", "--overwrite", *arguments, thickness=thickness)
        page = (self.folder / "r.html").read_text(errors="replace")
        self.require_view(page)
        return page

    def require_view(self, page):
        if "three.js" not in page:
            self.skipTest("built without three.js: the page has no view")


class PointTest(PageCase):
    def test_points_are_the_cells(self):
        """Against the labels and the thickness map."""
        data, octets = read_data(self.page("--lower", 72, "--thickness-map", "t.mha"))
        size = (60, 50, 40)
        labels = volumes.read_data(self.folder / "out.mha")
        lengths = volumes.read_floats(self.folder / "t.mha")
        cells = {
            (at % size[0], at // size[0] % size[1], at // (size[0] * size[1])): lengths[at]
            for at, label in enumerate(labels)
            if label >= 2
        }
        self.assertEqual((data["edge"], tuple(data["blocks"])), (1, size))
        rows = decode_points(data, octets)
        self.assertEqual([block for block, _, _ in rows], sorted(cells, key=lambda cell: cell[::-1]))
        kinds = set()
        for block, _, code in rows:
            kinds.add(code >= 2)
            if cells[block] < 0:
                self.assertEqual(code, 0, "at a rim")
            else:
                self.assertAlmostEqual((code - 2) * data["lengthUnit"], cells[block], delta=0.51 * data["lengthUnit"])
        self.assertEqual(kinds, {True, False})

    def test_importance_chooses_the_sheet_of_each_thickness(self):
        data, octets = read_data(self.page("--lower", 72, "--importance", "i.mha", "--min-thickness", 2, thickness="auto"))
        rows = decode_points(data, octets)
        codes = [importance for *_, importance in rows]
        self.assertEqual(data["importance"], [min(codes), max(codes)])
        self.assertAlmostEqual(max(codes) * data["lengthUnit"], 16, delta=data["lengthUnit"])
        lengths, size = volumes.read_floats(self.folder / "i.mha"), self.volume.size
        shown = {block for block, *_ in rows}
        for thickness in (6, 8, 12, 16):
            self.extract("in.mha", "fixed.mha", "--lower", 72, "--overwrite", "--max-pore-size", 32, thickness=thickness)
            labels = volumes.read_data(self.folder / "fixed.mha")
            medial = {(at % size[0], at // size[0] % size[1], at // (size[0] * size[1])) for at, label in enumerate(labels) if label > 1}
            chosen = {block for block, *_, importance in rows if importance * data["lengthUnit"] >= thickness - 1e-9}
            self.assertEqual(chosen, medial & shown, thickness)
        for block, *_, importance in rows:
            length = lengths[block[0] + size[0] * (block[1] + size[1] * block[2])]
            self.assertAlmostEqual(importance * data["lengthUnit"], length * 2 / math.pi, delta=data["lengthUnit"])

    def test_points_have_the_walls_of_their_cells(self):
        """Against the volume of the walls, also beside a mesh; all else of the points stays."""
        volume = part(tee)
        volumes.write_meta(self.folder / "tee.mha", volume)
        data, octets = read_data(self.page(source="tee.mha"))
        self.assertNotIn("walls", data)
        expected = decode_points(data, octets)
        for others in ((), ("--divisions", 7), ("--importance", "i.mha"), ("--mesh", "m.vtu", "--mesh-walls")):
            data, octets = read_data(self.page("--walls", "w.mha", *others, source="tee.mha"))
            self.assertEqual(data["walls"], 3)
            rows = decode_points(data, octets)
            self.assertEqual([row[:3] for row in rows], expected)
            self.assertEqual(data["edge"], 1)
            data = volumes.read_data(self.folder / "w.mha")
            numbers = struct.unpack(f"<{len(data) // 4}I", data)
            walls = [numbers[x + volume.size[0] * (y + volume.size[1] * z)] for (x, y, z), *_ in rows]
            self.assertEqual([row[-1] for row in rows], walls)
            self.assertGreater(sum(wall > 0 for wall in walls), 0.8 * len(walls), "all but rims")

    @unittest.skipUnless(ENGINE.exists(), f"{ENGINE} is not there")
    def test_points_of_a_large_sheet(self):
        """The edge of the blocks is the smallest power of two that keeps the budget."""
        self.run_program("extract", ENGINE, "e.mha", "--lower", 72, "--html", "e.html")
        page = (self.folder / "e.html").read_text()
        self.require_view(page)
        data, octets = read_data(page)
        size = (256, 256, 110)
        labels = volumes.read_data(self.folder / "e.mha")
        cells = [
            (match.start() % size[0], match.start() // size[0] % size[1], match.start() // (size[0] * size[1]))
            for match in re.finditer(rb"[\x02\x03]", labels)
        ]
        self.assertGreater(len(cells), BUDGET)
        groups = group_cells(cells, 2)
        self.assertLess(len(groups), BUDGET)
        self.assertEqual(data["edge"], 2)
        rows = decode_points(data, octets)
        self.assertEqual({block for block, _, _ in rows}, set(groups))
        for block, places, _ in rows:
            self.assertEqual(places, tuple(place_in_block(mean, index, 2) for mean, index in zip(groups[block], block)))

        edge, shares = decode_part(page)
        self.assertEqual(edge, 4, "a finer surface of half as many voxels has too many faces")
        self.assertLess(count_faces(shares), 30000)

    def test_part_is_the_object(self):
        """But for the last voxels along an axis, which have no cell."""
        edge, shares = decode_part(self.page("--lower", 72))
        self.assertEqual(edge, 1)
        self.assertEqual(set(shares.values()), {0, 15})
        objects = {
            index
            for index, value in zip(self.volume.indices(), self.volume.voxels)
            if value >= 72 and all(at < size - 1 for at, size in zip(index, self.volume.size))
        }
        self.assertEqual({block for block, share in shares.items() if share > 0}, objects)

    def test_thin_walls_are_in_the_part(self):
        """A wall of a voxel in blocks of eight of them, and a solid box beside it."""
        wall, box = (slice(20, 21), slice(10, 30), slice(100, 500)), (slice(24, 36), slice(9, 27), slice(520, 568))
        volume = volumes.Volume((600, 40, 48), bytearray(600 * 40 * 48))
        for zs, ys, xs in (wall, box):
            for z in range(zs.start, zs.stop):
                for y in range(ys.start, ys.stop):
                    start = (z * 40 + y) * 600
                    volume.voxels[start + xs.start : start + xs.stop] = bytes([100]) * (xs.stop - xs.start)
        volumes.write_meta(self.folder / "thin.mha", volume)
        edge, shares = decode_part(self.page("--lower", 72, source="thin.mha"))
        self.assertEqual(edge, 8)
        inside = {block for block, share in shares.items() if share >= 8}
        of_wall = {block for block in inside if block[0] < 64}
        self.assertEqual({z for _, _, z in of_wall}, {2})
        self.assertLessEqual({(x, y, 2) for x in range(13, 62) for y in (2, 3)}, of_wall)
        self.assertEqual([shares[68, 2, z] for z in (2, 3, 5)], [0, 15, 0], "the box, with its faces at 24 and 36")

    def test_division_threads_and_memory_do_not_change_it(self):
        whole = RUN.sub("", self.page("--lower", 72, "--threads", 1))
        for arguments in (("--threads", 4, "--divisions", 7), ("--divisions", 40), ("--memory", "72M")):
            self.assertTrue(RUN.sub("", self.page("--lower", 72, *arguments)) == whole, arguments)
        # Values of another output.
        whole = self.page("--lower", 72, "--importance", "i.mha")
        self.assertEqual(read_data(self.page("--lower", 72, "--importance", "i.mha", "--divisions", 7)), read_data(whole))

    def test_nothing_to_show(self):
        empty = volumes.Volume((9, 8, 7), [0] * 504)
        volumes.write_meta(self.folder / "empty.mha", empty)
        flat = volumes.Volume((30, 30), [])
        flat.voxels = [1 if 10 <= y < 14 else 0 for _, y in flat.indices()]
        volumes.write_meta(self.folder / "flat.mha", flat)
        for name in ("empty.mha", "flat.mha"):
            self.extract(name, "out.mha", "--html", "r.html", "--overwrite")
            self.assertFalse("<script" in (self.folder / "r.html").read_text(), name)

    def test_license_and_policy(self):
        page = self.page("--lower", 72)
        self.assertTrue("Permission is hereby granted, free of charge" in page)
        self.assertRegex(page[:300], "Content-Security-Policy\" content=\"default-src 'none'")


class JobTest(JobTestCase):
    @unittest.skipUnless(ENGINE.exists(), f"{ENGINE} is not there")
    def test_clusters_make_the_same(self):
        """The parts have other edges than the whole."""
        packed = ENGINE.read_bytes()[volumes.read_header(ENGINE)[1] :]
        (self.folder / "e.raw").write_bytes(zlib.decompress(packed))
        options = ["../e.raw", "e.mha", "--raw-size", "256,256,110", "--raw-type", "uint8", "--lower", 72]
        options += ["--thin-below", 4, "--html", "e.html", "--importance", "i.mha"]
        expected = self.expect("extract", *options)
        self.in_target("plan", *options[:2], "job", *options[2:], "--divisions", 3)
        self.in_target("work", "job", "--clusters", "1-2")
        self.in_target("work", "job")
        self.in_target("finalize", "job")
        page = RUN.sub("", (self.target / "e.html").read_text())
        self.assertTrue(page.encode() == expected["e.html"], "the page is that of one run")


class BrowserTest(PageCase):
    def test_checks_of_the_browser(self):
        python = python_with("numpy, PIL, selenium")
        if python is None or not all(map(shutil.which, ("chromium", "chromedriver"))):
            self.skipTest("no Chromium with its driver, Selenium, NumPy and Pillow: no browser shows the page")
        self.require_view(self.page("--lower", 72))
        command = [python, "-B", "-m", "unittest", "--verbose", "page_checks"]
        folder = pathlib.Path(__file__).parent
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertNotIn("skipped", done.stderr)


if __name__ == "__main__":
    unittest.main()
