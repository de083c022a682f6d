# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Local thickness against the definition, ball by ball in NumPy."""

import unittest

import itk
import numpy as np

from support import PIXEL_TYPES, blobs, image_of

# Numbers without rounding, so that equal lengths are equal.
SPACING = (0.5, 0.75, 1.25)

SPHERE = itk.MedialVoxelEnums.LocalThicknessMethod_Sphere


def largest_balls(mask, spacing, maximum):
    """The diameter of the largest ball that covers each voxel; the spacing is in the order of the axes."""
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
    def test_of_every_type_and_dimension(self):
        solid = blobs(shape=(14, 16, 18))
        for mask in (solid, solid[7]):
            spacing = SPACING[: mask.ndim]
            expected = largest_balls(mask, spacing[::-1], 40.0)
            self.assertGreater(len(np.unique(expected)), 4)
            for dtype in PIXEL_TYPES:
                with self.subTest(dtype=dtype, dimension=mask.ndim):
                    image = image_of(mask.astype(dtype), spacing=spacing)
                    found = itk.local_thickness_image_filter(image, method=SPHERE)
                    self.assertEqual(tuple(found.GetSpacing()), spacing)
                    np.testing.assert_array_equal(itk.array_from_image(found), expected)

    def test_of_arrays_in_voxels(self):
        mask = blobs(shape=(14, 16, 18))
        found = itk.local_thickness_image_filter(mask, method=SPHERE)
        self.assertEqual(found.dtype, np.float32)
        np.testing.assert_array_equal(found, largest_balls(mask, (1, 1, 1), 32))
        image = image_of(mask, spacing=SPACING)
        found = itk.array_from_image(itk.local_thickness_image_filter(image, method=SPHERE, use_image_spacing=False))
        np.testing.assert_array_equal(found, largest_balls(mask, (1, 1, 1), 32))

    def test_a_maximum(self):
        mask = blobs(shape=(14, 16, 18))
        thickness = itk.LocalThicknessImageFilter.New(image_of(mask), method=SPHERE, largest_ball=np.float32(4))
        thickness.Update()
        found = itk.array_from_image(thickness.GetOutput())
        np.testing.assert_array_equal(found, largest_balls(mask, (1, 1, 1), 4))
        self.assertEqual(thickness.GetCounts().objectVoxels, np.count_nonzero(mask))
        self.assertEqual(thickness.GetNumberOfVoxelsAtMaximum(), np.count_nonzero(found == 4))
        thickness.UnsetLargestBall()
        self.assertEqual(thickness.GetLargestBall(), 0)
        thickness.Update()
        np.testing.assert_array_equal(itk.array_from_image(thickness.GetOutput()), largest_balls(mask, (1, 1, 1), 32))

    def test_thresholds(self):
        values = np.random.default_rng(4).integers(0, 100, (10, 12, 14)).astype("int16")
        found = itk.local_thickness_image_filter(values, method=SPHERE, lower_threshold=20, upper_threshold=90)
        np.testing.assert_array_equal(found, largest_balls((values >= 20) & (values <= 90), (1, 1, 1), 32))

    def test_of_walls(self):
        plate = np.zeros((12, 30, 30), np.uint8)
        plate[4:7] = 1
        thickness = itk.LocalThicknessImageFilter.New(image_of(plate, spacing=(0.5, 0.5, 0.5)))
        self.assertEqual(thickness.GetMethod(), itk.MedialVoxelEnums.LocalThicknessMethod_Wall)
        thickness.Update()
        np.testing.assert_array_equal(itk.array_from_image(thickness.GetOutput()), 1.5 * plate)
        self.assertEqual(thickness.GetNumberOfVoxelsWithoutWall(), 0)

    def test_wrong_values(self):
        for maximum in (0, -1, float("nan"), float("inf"), 257):
            with self.subTest(maximum), self.assertRaisesRegex(RuntimeError, "LargestBall is .*; it must be"):
                itk.local_thickness_image_filter(blobs(shape=(14, 16, 18)), largest_ball=maximum)


if __name__ == "__main__":
    unittest.main()
