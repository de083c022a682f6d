# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The view of the page: its points are those of the cells, any division makes the same, and a browser shows it."""

import base64
import json
import pathlib
import re
import shutil
import subprocess
import unittest
import zlib

import volumes
from interpreters import python_with
from jobs import JobTestCase
from program import ProgramTestCase

RUN = re.compile(r'<section id="run">.*?</section>', re.DOTALL)
ENGINE = pathlib.Path(__file__).parents[3] / "shared/data/engine.mha"
BUDGET = 65536


def read_data(page):
    """What the page says about its points, and their bytes; None where it has no view."""
    data = re.search(r'<script type="text/plain" id="view-data">(.*?)</script>', page)
    points = re.search(r'<script type="text/plain" id="view-points">(.*?)</script>', page)
    return (json.loads(data[1]), base64.b64decode(points[1], validate=True)) if data else None


def decode_points(data, octets):
    """Rows of block, place in the block in 256ths and code, as the page documents its bytes."""
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
        rows.append((block, places, number()))
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
        volumes.write_meta(self.folder / "in.mha", volumes.box_with_plate(size=(60, 50, 40)))

    def page(self, *arguments, source="in.mha"):
        self.extract(source, "out.mha", "--html", "r.html", "--overwrite", *arguments)
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

    def test_division_threads_and_memory_do_not_change_it(self):
        whole = RUN.sub("", self.page("--lower", 72, "--threads", 1))
        for arguments in (("--threads", 4, "--divisions", 7), ("--divisions", 40), ("--memory", "72M")):
            self.assertTrue(RUN.sub("", self.page("--lower", 72, *arguments)) == whole, arguments)

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
        options += ["--thin-below", 4, "--html", "e.html"]
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
