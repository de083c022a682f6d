# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Vector and signed distances against ITK's and scipy's transforms."""

import unittest

import itk
import numpy as np

from support import blobs, image_of

SPACING = (0.5, 0.75, 1.25)


class VectorDistances(unittest.TestCase):
    def test_norms_are_those_of_signed_maurer(self):
        for spacing in ((1.0, 1.0, 1.0), SPACING):
            image = image_of(blobs(), spacing=spacing)
            vectors = itk.vector_distance_map_image_filter(image)
            maurer = itk.signed_maurer_distance_map_image_filter(
                image, squared_distance=False, use_image_spacing=True, inside_is_positive=False
            )
            norms = np.linalg.norm(itk.array_view_from_image(vectors).astype(float), axis=-1)
            np.testing.assert_allclose(norms, np.abs(itk.array_view_from_image(maurer)), rtol=1e-6)

    def test_norms_are_those_of_scipy(self):
        try:
            from scipy import ndimage
        except ImportError as error:
            self.skipTest(f"skipped: {error}")
        mask = blobs()
        vectors = itk.vector_distance_map_image_filter(
            image_of(mask, spacing=SPACING),
            boundary=itk.MedialVoxelEnums.Boundary_Background,
            region=itk.MedialVoxelEnums.Region_Inside,
        )
        norms = np.linalg.norm(itk.array_view_from_image(vectors).astype(float), axis=-1)
        np.testing.assert_allclose(norms, ndimage.distance_transform_edt(mask, sampling=SPACING[::-1]), rtol=1e-6)

    def test_vectors_end_at_the_boundary(self):
        mask = blobs()
        vectors = itk.array_from_image(itk.vector_distance_map_image_filter(image_of(mask)))
        self.assertEqual(vectors.shape, (*mask.shape, 3))
        # Components are x, y, z; axes are z, y, x.
        ends = np.stack(np.indices(mask.shape)[::-1], axis=-1) + np.rint(vectors).astype(int)
        values = mask[ends[..., 2], ends[..., 1], ends[..., 0]]
        self.assertTrue(values.all(), "a vector leads to no voxel of the object")

    def test_signed_distance(self):
        image = image_of(blobs(), spacing=SPACING)
        distance = itk.VectorDistanceMapImageFilter.New(image, generate_distance=True)
        distance.Update()
        maurer = itk.signed_maurer_distance_map_image_filter(
            image, squared_distance=False, use_image_spacing=True, inside_is_positive=False
        )
        np.testing.assert_allclose(
            itk.array_view_from_image(distance.GetDistanceOutput()), itk.array_view_from_image(maurer), rtol=1e-6
        )

    def test_a_narrow_band(self):
        image = image_of(blobs())
        everywhere = itk.array_from_image(itk.vector_distance_map_image_filter(image))
        band = itk.array_from_image(itk.vector_distance_map_image_filter(image, maximum_distance=2.0))
        far = np.linalg.norm(everywhere, axis=-1) > 2
        self.assertTrue(far.any())
        self.assertTrue(np.isnan(band[far]).all())
        np.testing.assert_array_equal(band[~far], everywhere[~far])


if __name__ == "__main__":
    unittest.main()
