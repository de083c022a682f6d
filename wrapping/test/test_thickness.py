# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The thickness output of the medial voxel filter as Python users get it."""

import unittest

import itk
import numpy as np

from support import blobs, image_of, plate


def measured(image, **options):
    """Labels and thickness as arrays."""
    medial = itk.MedialVoxelImageFilter.New(image, generate_thickness=True, **options)
    medial.Update()
    return (itk.array_from_image(output) for output in (medial.GetOutput(), medial.GetThicknessOutput()))


class Thickness(unittest.TestCase):
    def test_plates_are_exact_in_both_units(self):
        for thickness in range(1, 9):
            for options, unit in (({}, 0.75), ({"use_image_spacing": False}, 1.0)):
                with self.subTest(thickness=thickness, options=options):
                    image = image_of(plate(thickness=thickness), spacing=(0.5, 0.75, 1.25))
                    labels, values = measured(image, thickness=1.5, **options)
                    self.assertEqual(values.shape, (20, 24, 28))
                    self.assertEqual(values.dtype, np.float32)
                    self.assertTrue((values[labels >= 2] == np.float32(thickness * unit)).all())
                    self.assertTrue((labels >= 2).sum() >= 19 * 27)
                    self.assertFalse(values[labels < 2].any())

    def test_geometry_is_that_of_the_labels(self):
        image = image_of(blobs(), spacing=(0.5, 0.75, 2.0), origin=(10.0, 20.0, -5.0))
        medial = itk.MedialVoxelImageFilter.New(image, thickness=3.0, generate_thickness=True)
        medial.Update()
        labels, thickness = medial.GetOutput(), medial.GetThicknessOutput()
        self.assertIsInstance(thickness, itk.Image[itk.F, 3])
        self.assertEqual(list(thickness.GetOrigin()), list(labels.GetOrigin()))
        self.assertEqual(list(thickness.GetSpacing()), list(labels.GetSpacing()))

    def test_output_comes_and_goes(self):
        medial = itk.MedialVoxelImageFilter.New(image_of(blobs()), thickness=3.0)
        self.assertIsNone(medial.GetThicknessOutput())
        medial.GenerateThicknessOn()
        medial.Update()
        self.assertTrue(itk.array_view_from_image(medial.GetThicknessOutput()).any())
        medial.GenerateThicknessOff()
        self.assertIsNone(medial.GetThicknessOutput())

    def test_the_call_still_returns_one_image(self):
        image = image_of(blobs())
        labels = itk.medial_voxel_image_filter(image, thickness=3.0)
        with_thickness = itk.medial_voxel_image_filter(image, thickness=3.0, generate_thickness=True)
        self.assertIsInstance(with_thickness, itk.Image[itk.UC, 3])
        np.testing.assert_array_equal(itk.array_view_from_image(with_thickness), itk.array_view_from_image(labels))

    def test_streamed_pieces_are_the_whole(self):
        image = image_of(blobs())
        _, expected = measured(image, thickness=3.0)
        medial = itk.MedialVoxelImageFilter.New(image, thickness=3.0, generate_thickness=True)
        pieces = itk.StreamingImageFilter.New(medial.GetThicknessOutput(), number_of_stream_divisions=7)
        pieces.Update()
        np.testing.assert_array_equal(itk.array_view_from_image(pieces.GetOutput()), expected)

    def test_gray_values(self):
        """A wall of 4.5 voxels: the outer ones hold a part of it, which only gray values tell."""
        values = np.zeros((20, 24, 28), "int16")
        values[:, 10:14] = 1000
        values[:, 9] = values[:, 14] = 250
        image = image_of(values)
        options = {"thickness": 3.0, "lower_threshold": 500}
        labels, binary = measured(image, **options)
        same, gray = measured(image, subvoxel_thickness=True, **options)
        np.testing.assert_array_equal(labels, same)
        self.assertEqual(set(binary[labels >= 2]), {4.0})
        # Linear between 250 and 1000: a third of a voxel outside of the middle of the outer voxels, on both sides.
        np.testing.assert_allclose(gray[labels >= 2], 5 - 2 / 3, atol=1e-5)
        self.assertFalse(gray[labels < 2].any())

    def test_plane_images(self):
        mask = np.zeros((30, 40), "uint8")
        mask[8:13] = 1
        labels, values = measured(image_of(mask), thickness=3.0)
        self.assertEqual(set(values[labels >= 2]), {5.0})


if __name__ == "__main__":
    unittest.main()
