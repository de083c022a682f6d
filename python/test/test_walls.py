# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Walls and seams of arrays: the numbers and tables of the program for a file of the same values, with the axes of NumPy."""

import csv
import unittest

import medialvoxel
import numpy as np

from support import ORDERS, Folder, program, read, run, write

SPACING = (1.5, 1.0, 0.75)


def beam(seed=4):
    """An I-beam along y with a rough surface, of values about 20 and 80."""
    values = np.zeros((34, 40, 48))
    values[4:8, 4:36, 4:44] = values[26:30, 4:36, 4:44] = values[6:28, 4:36, 22:26] = 60
    return np.floor(20 + values + np.random.default_rng(seed).normal(0, 12, values.shape)).astype(np.int16)


class WallsTest(Folder):
    def assert_same(self, found, values, *options):
        """As the program has it, number by number."""
        program()
        write(self.folder / "in.mha", values, SPACING)
        names = [self.folder / name for name in ("w.mha", "w.csv", "s.csv")]
        files = [f"--{option}={name}" for option, name in zip(("walls", "wall-table", "seam-table"), names)]
        status, errors = run(["extract", self.folder / "in.mha", *files, "--overwrite", "--quiet", *options])
        self.assertEqual(status, 0, errors)
        np.testing.assert_array_equal(found.numbers, read(names[0]))
        tables = []
        for name in names[1:]:
            with name.open(newline="") as file:
                tables.append(list(csv.DictReader(file)))
        self.assertEqual([wall.number for wall in found.walls], [int(row["wall"]) for row in tables[0]])
        for wall, row in zip(found.walls, tables[0]):
            for name in ("cells", "area", "flatness", "rim_length"):
                self.assertEqual(getattr(wall, name), float(row[name]))
            for name in ("mean", "minimum", "maximum", "standard_deviation"):
                np.testing.assert_equal(getattr(wall, name), float(row[f"thickness_{name}"] or "nan"))
            for name in ("centroid", "normal"):
                self.assertEqual(getattr(wall, name), tuple(float(row[f"{name}_{axis}"]) for axis in "zyx"))
            self.assertEqual(wall.neighbors, tuple(map(int, row["neighbors"].split())))
        self.assertEqual([seam.walls for seam in found.seams], [tuple(map(int, row["walls"].split())) for row in tables[1]])
        for seam, row in zip(found.seams, tables[1]):
            self.assertEqual(seam.length, float(row["length"]))
            angles = [float("nan") if word == "null" else float(word) for word in row["angles"].split()]
            np.testing.assert_equal(seam.angles, angles)

    def test_as_the_program(self):
        values = beam()
        for keywords, options in (
            ({"lower": 50}, ["--lower=50"]),
            ({"lower": 50, "sub_voxel": False, "smooth": True}, ["--lower=50", "--sub-voxel=off", "--smooth=on"]),
            ({"lower": 50, "materials": (20, 80), "max_thickness": 9}, ["--lower=50", "--materials=20,80", "--max-thickness=9"]),
        ):
            with self.subTest(keywords):
                found = medialvoxel.walls(values, spacing=SPACING, **keywords)
                self.assertEqual(found.lower, 50)
                self.assertGreater(len(found.walls), 2)
                self.assertGreater(len(found.seams), 0)
                self.assert_same(found, values, *options)
                for threads in (1, 2, 5):
                    other = medialvoxel.walls(values, spacing=SPACING, threads=threads, memory="100M", **keywords)
                    np.testing.assert_array_equal(other.numbers, found.numbers)
                    self.assertEqual((other.walls, other.seams), (found.walls, found.seams))

    def test_masks_of_every_order(self):
        mask = beam() >= 50
        known = medialvoxel.walls(mask, spacing=SPACING)
        self.assert_same(known, mask.astype(np.uint8))
        self.assertEqual(known.numbers.dtype, np.uint32)
        for order in ORDERS.values():
            found = medialvoxel.walls(order(mask.astype(np.uint8)), spacing=SPACING, label=1)
            np.testing.assert_array_equal(found.numbers, known.numbers)
            self.assertEqual(found.walls, known.walls)

    def test_a_known_part(self):
        part = np.zeros((44, 40, 48), bool)
        part[4:8, 4:36, 4:44] = part[36:40, 4:36, 4:44] = part[6:38, 4:36, 22:26] = True
        found = medialvoxel.walls(part, spacing=0.5)
        self.assertEqual((len(found.walls), len(found.seams)), (5, 2))
        self.assertEqual(repr(found), "Walls(numbers=uint32[44, 40, 48], 5 walls, 2 seams)")
        counts = np.bincount(found.numbers.ravel())
        self.assertEqual(counts[1:].tolist(), [wall.cells for wall in found.walls])
        (web,) = (wall for wall in found.walls if len(wall.neighbors) == 4)
        np.testing.assert_allclose(np.abs(web.normal), (0, 0, 1), atol=1e-3)
        np.testing.assert_allclose(web.centroid, (0.5 * 21.5, 0.5 * 19.5, 0.5 * 23.5), atol=0.3)
        self.assertAlmostEqual(web.mean, 2, delta=0.2)
        self.assertTrue(all(web.number in seam.walls for seam in found.seams))
        medial = medialvoxel.extract(part, spacing=0.5).medial
        self.assertLess(np.count_nonzero((found.numbers > 0) & ~medial), 0.05 * np.count_nonzero(medial))  # few are beside

    def test_nothing_and_errors(self):
        with self.assertWarnsRegex(medialvoxel.MedialVoxelWarning, "no object"):
            empty = medialvoxel.walls(np.zeros((9, 9, 9)))
        self.assertEqual((empty.walls, empty.seams, empty.numbers.any()), ([], [], False))
        for array, keywords, message in (
            (np.ones((9, 9)), {}, "the array has 2 axes; walls need 3"),
            (beam(), {"lower": 50, "upper": 40}, "lower threshold 50 is greater"),
            (beam(), {"thickness": -1}, "--thickness"),
        ):
            with self.subTest(message), self.assertRaisesRegex(ValueError, message):
                medialvoxel.walls(array, **keywords)
        with self.assertRaisesRegex(MemoryError, "the walls need more than"):
            medialvoxel.walls(np.arange(150)[:, None, None] % 8 + np.zeros((1, 150, 150)) < 3, memory="90M")


if __name__ == "__main__":
    unittest.main()
