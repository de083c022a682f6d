# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Local thickness against the definition, ball by ball in NumPy, for every type and memory order."""

import unittest

import medialvoxel
import numpy as np

from support import INTEGERS, ORDERS, REALS, scene

SHAPE = (14, 18, 20)

# Numbers without rounding, so that equal lengths are equal.
SPACING = (1.5, 1.0, 0.75)


def largest_balls(mask, spacing, maximum):
    """The diameter of the largest ball that covers each voxel."""
    places = np.stack(np.indices(mask.shape), axis=-1).reshape(-1, mask.ndim) * np.array(spacing, float)
    inside = mask.ravel() != 0
    found = np.zeros(inside.size)
    for center in places[inside]:
        squares = ((places - center) ** 2).sum(axis=1)
        radius = min(squares[~inside].min(initial=np.inf), maximum**2 / 4)
        covered = squares < radius
        found[covered] = np.maximum(found[covered], radius)
    return (2 * np.sqrt(found)).astype(np.float32).reshape(mask.shape)


class LocalThickness(unittest.TestCase):
    def assert_same(self, found, expected):
        self.assertEqual(found.thickness.dtype, np.float32)
        np.testing.assert_array_equal(found.thickness, expected)
        self.assertTrue(found.thickness.flags.owndata and found.thickness.flags.c_contiguous)
        self.assertTrue(found.thickness.flags.writeable)
        self.assertEqual(found.counts["object_voxels"], np.count_nonzero(expected))

    def test_of_every_type_and_order(self):
        expected = largest_balls(scene(SHAPE) >= 40, SPACING, 48)
        self.assertGreater(len(np.unique(expected)), 5)
        for dtype in [*INTEGERS, *REALS, "bool"]:
            values = scene(SHAPE) >= 40 if dtype == "bool" else scene(SHAPE).astype(dtype)
            for order, arrange in ORDERS.items():
                with self.subTest(dtype=dtype, order=order):
                    array = arrange(values)
                    before = array.copy()
                    lower = None if dtype == "bool" else 40
                    self.assert_same(medialvoxel.local_thickness(array, spacing=SPACING, lower=lower, method="sphere"), expected)
                    np.testing.assert_array_equal(array, before)

    def test_with_every_option(self):
        values = scene(SHAPE).astype("int16")
        solid = (values >= 40) & (values <= 90)
        cases = [
            ({"lower": 40, "upper": 90}, solid, SPACING, 48),
            ({"lower": 40, "upper": 90, "largest_ball": 4}, solid, SPACING, 4),
            ({"lower": 40, "upper": 90, "largest_ball": np.float32(2.5)}, solid, SPACING, 2.5),
            ({"lower": 40, "upper": 90, "largest_ball": "4vx"}, solid, SPACING, 3),
            ({"lower": 40, "upper": 90, "threads": 1, "memory": "1M"}, solid, SPACING, 48),
            ({"label": 0}, values == 0, SPACING, 48),
            ({}, values != 0, SPACING, 48),
        ]
        for keywords, mask, spacing, maximum in cases:
            with self.subTest(keywords):
                found = medialvoxel.local_thickness(values, spacing=SPACING, method="sphere", **keywords)
                self.assert_same(found, largest_balls(mask, spacing, maximum))
                at_maximum = np.count_nonzero(found.thickness == np.float32(maximum))
                self.assertEqual(found.counts["voxels_at_maximum"], at_maximum)

    def test_otsu_measures_the_threshold(self):
        found = medialvoxel.local_thickness(scene(SHAPE), lower="otsu", method="sphere")
        self.assertEqual(found.lower, medialvoxel.distance(scene(SHAPE), lower="otsu").lower)
        self.assert_same(found, largest_balls(scene(SHAPE) >= found.lower, (1, 1, 1), 32))

    def test_two_dimensions(self):
        mask = scene()[4] >= 40
        self.assert_same(medialvoxel.local_thickness(mask, spacing=(1.0, 0.5), method="sphere"), largest_balls(mask, (1.0, 0.5), 32))

    def test_nothing_but_object_and_nothing_at_all(self):
        full = medialvoxel.local_thickness(np.ones((5, 6, 7)), largest_ball=3, method="sphere")
        self.assertEqual((full.thickness == 3).sum(), full.counts["voxels_at_maximum"])
        self.assert_same(medialvoxel.local_thickness(np.zeros((5, 6, 7))), np.zeros((5, 6, 7), np.float32))

    def test_walls(self):
        plate = np.zeros((12, 40, 40), bool)
        plate[3:6, 4:30] = True
        found = medialvoxel.local_thickness(plate, spacing=(0.5, 1, 1))
        np.testing.assert_array_equal(found.thickness == 0, ~plate)
        inner = found.thickness[3:6, 8:26]
        self.assertEqual(np.unique(inner).tolist(), [1.5])
        self.assertEqual(np.isnan(found.thickness).sum(), found.counts["voxels_without_wall"])
        self.assertLess(found.counts["voxels_without_wall"], 0.1 * found.counts["object_voxels"])
        sphere = medialvoxel.local_thickness(plate, spacing=(0.5, 1, 1), method="sphere")
        self.assertEqual((sphere.counts["voxels_without_wall"], float(sphere.thickness.max())), (0, 2.0))

    def test_walls_on_gray_values(self):
        """The same values as at the medial cells, which are not whole numbers of voxels."""
        z, y, x = np.indices((36, 38, 40), float) - 18
        away = abs(0.2 * x + 0.37 * y + 0.91 * z) / np.sqrt(0.2**2 + 0.37**2 + 0.91**2) - 3.2
        scan = 1000 / (1 + np.exp(2.5 * away))
        cells = medialvoxel.extract(scan, lower=500, smooth="off", max_pore_size=0).thickness
        found = medialvoxel.local_thickness(scan, lower=500).thickness
        part = found[scan >= 500]
        self.assertLessEqual(set(part[~np.isnan(part)].tolist()), set(cells[cells > 0].tolist()))
        self.assertAlmostEqual(float(np.nanmedian(part)), 6.4, delta=0.05)
        on_object = medialvoxel.local_thickness(scan, lower=500, sub_voxel=False).thickness
        self.assertFalse(np.array_equal(found, on_object, equal_nan=True))

    def test_wrong_values(self):
        cases = [
            ({"lower": 40, "sub_voxel": True, "method": "sphere"}, "no effect with the method sphere"),
            ({"sub_voxel": True}, "sub-voxel measures need a threshold"),
            ({"method": "ball"}, "--local-thickness-method"),
            ({"largest_ball": 0}, "--largest-ball: '0' is not a finite number greater than 0"),
            ({"largest_ball": float("nan")}, "--largest-ball: 'nan' is not a finite number"),
            ({"largest_ball": 300}, "at most 256 voxels"),
            ({"largest_ball": "thick"}, "--largest-ball: 'thick' is not a finite number"),
            ({"lower": 5, "upper": 3}, "5"),
            ({"threads": 0}, "--threads"),
            ({"spacing": (1, 1, 0)}, "axis 2 is 0"),
        ]
        for keywords, message in cases:
            with self.subTest(keywords), self.assertRaises(ValueError) as caught:
                medialvoxel.local_thickness(scene(SHAPE), **keywords)
            self.assertIn(message, str(caught.exception))
        with self.assertRaises(MemoryError):
            medialvoxel.local_thickness(scene(), lower=40, memory=1)


if __name__ == "__main__":
    unittest.main()
