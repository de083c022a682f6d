# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Pores and dust: what counts as noise, with each thickness, and the same bytes for any division and memory."""

import json
import random
import unittest

import volumes
from program import ProgramTestCase


def solid(size=(44, 40, 36)):
    """A plate of 16 voxels without noise; it leaves the volume along y."""
    volume = volumes.Volume(size, [])
    volume.voxels = [1 if 8 <= z < 24 and 6 <= x < 38 else 0 for x, _, z in volume.indices()]
    return volume


def with_noise(volume, length=3):
    """Lines of voxels, some deep in the plate and some far from it, that touch neither surface nor each other."""
    noisy = volumes.Volume(volume.size, volume.voxels, volume.spacing)
    width, height, _ = volume.size
    filled = removed = 0
    choose = random.Random(5)
    for z in (3, 12, 16, 20, 28, 33):
        for y in range(4, 36, 4):
            x = choose.randrange(10, 30)
            kind = volume.voxels[(z * height + y) * width + x]
            for i in range(length):
                noisy.voxels[(z * height + y) * width + x + i] = 1 - kind
            filled += length * kind
            removed += length * (1 - kind)
    return noisy, filled, removed


class PoresTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.clean = solid()
        self.noisy, self.filled, self.removed = with_noise(self.clean)
        volumes.write_meta(self.folder / "clean.mha", self.clean)
        volumes.write_meta(self.folder / "in.mha", self.noisy)

    def results(self, *arguments, source="in.mha"):
        self.run_program("extract", source, "l.mha", "--thickness-map", "t.mha", "--report", "r.json", "--overwrite", "--smooth", "off", *arguments)
        report = json.loads((self.folder / "r.json").read_text())
        return [volumes.read_data(self.folder / name) for name in ("l.mha", "t.mha")], report

    def test_the_result_is_that_without_the_noise(self):
        for thickness in (["--thickness", 3], ["--thickness", "auto"]):
            expected, clean = self.results(*thickness, "--max-pore-size", 0, source="clean.mha")
            actual, report = self.results(*thickness, "--max-pore-size", 3)
            self.assertEqual(actual, expected)
            self.assertEqual(report["counts"]["filled_voxels"], self.filled)
            self.assertEqual(report["counts"]["removed_voxels"], self.removed)
            self.assertEqual(report["parameters"]["max_pore_size"], 3)
            same = {name: n for name, n in clean["counts"].items() if name not in ("filled_voxels", "removed_voxels")}
            self.assertEqual({name: report["counts"][name] for name in same}, same)
            kept, report = self.results(*thickness, "--max-pore-size", 2)
            self.assertNotEqual(kept, expected)
            self.assertEqual(report["counts"]["filled_voxels"] + report["counts"]["removed_voxels"], 0)

    def test_defaults(self):
        for arguments, size in (([], 32), (["--thickness", 3], 0), (["--max-pore-size", 0], 0)):
            _, report = self.results(*arguments)
            self.assertEqual(report["parameters"]["max_pore_size"], size)
            self.assertEqual(report["counts"]["filled_voxels"], self.filled if size else 0)
        table = self.run_program("extract", "in.mha", "l.mha", "--overwrite", "--smooth", "off").stdout
        self.assertRegex(table, rf"decided .*, pores of {self.filled} voxels filled")
        self.assertRegex(table, rf"decided .*, dust of {self.removed} voxels left out\n")
        self.assertNotIn("dust", self.run_program("extract", "clean.mha", "l.mha", "--overwrite").stdout)

    def test_divisions_threads_and_memory(self):
        expected, report = self.results("--divisions", 1, "--threads", 1)
        volumes.write_nrrd(self.folder / "packed.nrrd", self.noisy, compressed=True)
        for source, arguments in (
            ("in.mha", ["--divisions", 36, "--threads", 2]),
            ("in.mha", ["--divisions", 5, "--threads", 5]),
            ("in.mha", ["--memory", "32M", "--threads", 1]),
            ("packed.nrrd", ["--divisions", 7]),
        ):
            actual, other = self.results(*arguments, source=source)
            self.assertEqual(actual, expected, arguments)
            self.assertEqual(other["counts"], report["counts"], arguments)

    def test_thickness_on_gray_values(self):
        gray = self.noisy.as_type("uint8")
        gray.voxels = [60 + 100 * value for value in self.noisy.voxels]
        volumes.write_meta(self.folder / "gray.mha", gray)
        results = [
            self.results("--lower", 110, "--sub-voxel", "--divisions", divisions, source="gray.mha")
            for divisions in (1, 9)
        ]
        self.assertEqual(results[0][0], results[1][0])
        for _, report in results:
            self.assertEqual(report["counts"]["filled_voxels"], self.filled)
            self.assertEqual(report["thickness"]["percentiles"]["50"], 16)

    def test_meshes(self):
        def mesh(*arguments):
            self.run_program("mesh", *arguments, "--overwrite", "--smooth", "off")
            return (self.folder / arguments[1]).read_bytes()

        expected = mesh("clean.mha", "out.ply")
        self.assertEqual(mesh("in.mha", "out.ply"), expected)
        self.assertEqual(mesh("in.mha", "out.ply", "--divisions", 6), expected)
        self.assertNotEqual(mesh("in.mha", "out.ply", "--max-pore-size", 0), expected)


if __name__ == "__main__":
    unittest.main()
