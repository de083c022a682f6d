# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""One line each to the packages that people look at volumes with; a package that is not installed is skipped."""

import importlib.util
import unittest

import itk
import numpy as np

from support import blobs, image_of, plate


def needs(package):
    return unittest.skipUnless(importlib.util.find_spec(package), f"skipped: {package} is not installed")


class Interoperation(unittest.TestCase):
    def setUp(self):
        self.labels = itk.medial_voxel_image_filter(image_of(blobs(), spacing=(0.5, 0.5, 2.0)), thickness=3.0)
        self.array = itk.array_from_image(self.labels)

    @needs("scipy")
    def test_scipy_labels_the_sheets(self):
        from scipy import ndimage

        _, number = ndimage.label(itk.medial_voxel_image_filter(plate(), thickness=3.0) >= 2, np.ones((3, 3, 3)))
        self.assertEqual(number, 1)

    @needs("xarray")
    def test_xarray_keeps_the_geometry(self):
        data = itk.xarray_from_image(self.labels)
        np.testing.assert_array_equal(data.values, self.array)
        self.assertEqual(data.dims, ("z", "y", "x"))
        self.assertEqual(float(data.coords["z"][1] - data.coords["z"][0]), 2.0)
        back = itk.medial_voxel_image_filter(itk.image_from_xarray(data), thickness=3.0, lower_threshold=2)
        self.assertEqual(list(back.GetSpacing()), [0.5, 0.5, 2.0])

    @needs("pyvista")
    def test_pyvista_has_the_cells(self):
        import pyvista

        grid = pyvista.wrap(itk.vtk_image_from_image(self.labels))
        self.assertEqual(grid.dimensions, self.array.shape[::-1])
        self.assertEqual(tuple(grid.spacing), (0.5, 0.5, 2.0))
        self.assertEqual(grid.threshold(2).n_points > 0, (self.array >= 2).any())


if __name__ == "__main__":
    unittest.main()
