# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Zarr folders with large slices are done in rows when memory is small; the files have the same bytes."""

import json
import pathlib
import re
import zlib

from program import ProgramTestCase

# Slices of 10 MiB of results, of which a slab does not fit the memory below.
SIZE = (2000, 1100, 150)
CHUNK = 100
MEMORY = "110M"


def write_sheets(folder):
    """Shells around some corners of chunks, a plate to the last slice, and no chunk elsewhere."""
    folder = pathlib.Path(folder)
    folder.mkdir()
    description = {
        "zarr_format": 2, "shape": SIZE[::-1], "chunks": [CHUNK] * 3, "dtype": "|u1", "fill_value": 0, "order": "C",
        "compressor": {"id": "zlib", "level": 1}, "filters": None, "dimension_separator": "/",
    }  # fmt: skip
    (folder / ".zarray").write_text(json.dumps(description))
    chunks = {}

    def fill_row(begin, end, y, z):
        for x in range(max(0, begin), min(end, SIZE[0])):
            index = (z // CHUNK, y // CHUNK, x // CHUNK)
            voxels = chunks.setdefault(index, bytearray(CHUNK**3))
            voxels[(z % CHUNK * CHUNK + y % CHUNK) * CHUNK + x % CHUNK] = 1

    for center, radius in (((400, 220, 60), 25), ((1210, 440, 32), 20), ((1990, 660, 100), 30), ((800, 1000, 75), 12)):
        for z in range(center[2] - radius, center[2] + radius + 1):
            for y in range(center[1] - radius, center[1] + radius + 1):
                rest = radius**2 - (y - center[1]) ** 2 - (z - center[2]) ** 2
                if rest >= 0:
                    outer = int(rest**0.5)
                    hole = rest - radius**2 + (radius - 4) ** 2
                    inner = int(hole**0.5) if hole >= 0 else -1
                    fill_row(center[0] - outer, center[0] - inner, y, z)
                    fill_row(center[0] + inner + 1, center[0] + outer + 1, y, z)
    for y in range(200, 240):
        for z in range(120, SIZE[2]):
            fill_row(1500, 1504, y, z)
    for index, voxels in chunks.items():
        path = folder.joinpath(*map(str, index))
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(zlib.compress(bytes(voxels), 1))


class ZarrRowsTest(ProgramTestCase):
    OUTPUTS = ("l.zarr", "--thickness-map", "t.zarr", "--report", "r.json", "--overwrite", "--quiet")

    def setUp(self):
        super().setUp()
        write_sheets(self.folder / "s.zarr")

    def extract_all(self, *arguments):
        self.run_program("extract", "s.zarr", *self.OUTPUTS, "--thickness", "6", *arguments)
        contents = {
            str(path.relative_to(self.folder)): path.read_bytes()
            for name in ("l.zarr", "t.zarr")
            for path in (self.folder / name).rglob("*")
            if path.is_file()
        }
        report = json.loads((self.folder / "r.json").read_text())
        return contents, report["counts"], report["thickness"], report

    def plan(self, *arguments):
        result = self.run_program("extract", "s.zarr", *self.OUTPUTS, "--thickness", "6", "--dry-run", *arguments)
        return re.search(r"pieces +(.*)", result.stdout).group(1)

    def test_rows_give_the_same_bytes(self):
        for sparse in ((), ("--sparse",)):
            self.assertNotIn("rows", self.plan("--memory", "4G", "--threads", "1", *sparse))
            expected = self.extract_all("--memory", "4G", "--divisions", "1", "--threads", "1", *sparse)
            self.assertGreater(expected[1]["medial_cells"], 10000)
            for more in (
                ("--memory", MEMORY, "--threads", "1"),
                ("--memory", MEMORY, "--threads", "1", "--divisions", "7"),
                ("--memory", "128M", "--threads", "2"),
            ):
                arguments = (*more, *sparse)
                self.assertIn("rows at once", self.plan(*arguments))
                found = self.extract_all(*arguments)
                self.assertEqual(found[:3], expected[:3], arguments)
                self.assertLessEqual(found[3]["peak_memory_bytes"], found[3]["memory_limit_bytes"], arguments)
