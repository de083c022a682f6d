# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The medial voxel filter as Python users call it."""

import pydoc
import unittest

import itk
import numpy as np

from support import PIXEL_TYPES, blobs, image_of, plate


class MedialVoxels(unittest.TestCase):
    def test_an_image_gives_an_image(self):
        labels = itk.medial_voxel_image_filter(image_of(plate()), thickness=3.0)
        self.assertIsInstance(labels, itk.Image[itk.UC, 3])
        medial = itk.array_view_from_image(labels) >= 2
        self.assertEqual(medial.shape, (20, 24, 28))
        # One cell in each column but for the last index, which has no cell: midway in voxels 10 to 13.
        self.assertTrue((medial[:-1, :, :-1].sum(axis=1) == 1).all())
        self.assertTrue(medial[:-1, 11, :-1].all())
        self.assertFalse(medial[-1].any() or medial[:, :, -1].any())

    def test_an_array_gives_an_array(self):
        mask = blobs()
        from_array = itk.medial_voxel_image_filter(mask, thickness=3.0)
        self.assertIsInstance(from_array, np.ndarray)
        from_image = itk.array_from_image(itk.medial_voxel_image_filter(image_of(mask), thickness=3.0))
        np.testing.assert_array_equal(from_array, from_image)

    def test_a_view_is_taken_without_a_copy(self):
        mask = blobs()
        view = itk.image_view_from_array(mask)
        first = itk.array_from_image(itk.medial_voxel_image_filter(view, thickness=3.0))
        mask[...] = 0
        view.Modified()
        self.assertTrue((first >= 2).any())
        self.assertFalse(itk.array_from_image(itk.medial_voxel_image_filter(view, thickness=3.0)).any())

    def test_geometry_of_the_output(self):
        turned = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
        image = image_of(plate(), spacing=(0.5, 0.75, 2.0), origin=(10.0, 20.0, -5.0), direction=turned)
        labels = itk.medial_voxel_image_filter(image, thickness=3.0)
        self.assertEqual(list(labels.GetSpacing()), [0.5, 0.75, 2.0])
        np.testing.assert_array_equal(itk.array_from_matrix(labels.GetDirection()), turned)
        # Half a voxel along each axis of the image.
        shift = np.asarray(turned) @ (0.5 * np.array([0.5, 0.75, 2.0]))
        np.testing.assert_allclose(list(labels.GetOrigin()), np.array([10.0, 20.0, -5.0]) + shift, rtol=1e-14)

    def test_every_pixel_type_and_dimension(self):
        for name, pixel_type in PIXEL_TYPES.items():
            for mask in (blobs(name), blobs(name, (40, 50))):
                with self.subTest(type=name, dimension=mask.ndim):
                    image = image_of(mask)
                    self.assertIsInstance(image, itk.Image[pixel_type, mask.ndim])
                    labels = itk.medial_voxel_image_filter(image, thickness=3.0)
                    expected = itk.medial_voxel_image_filter(image_of(mask.astype("uint8")), thickness=3.0)
                    np.testing.assert_array_equal(itk.array_view_from_image(labels), itk.array_view_from_image(expected))

    def test_the_call_returns_one_image_also_with_vectors(self):
        image = image_of(blobs())
        labels = itk.medial_voxel_image_filter(image, thickness=3.0)
        with_vectors = itk.medial_voxel_image_filter(image, thickness=3.0, generate_vector_distance=True)
        self.assertIsInstance(with_vectors, itk.Image[itk.UC, 3])
        np.testing.assert_array_equal(itk.array_view_from_image(with_vectors), itk.array_view_from_image(labels))

    def test_vectors_and_counts_of_the_object(self):
        mask = blobs()
        image = image_of(mask)
        medial = itk.MedialVoxelImageFilter.New(image, thickness=3.0, generate_vector_distance=True)
        medial.Update()
        labels = itk.array_view_from_image(medial.GetOutput())
        vectors = itk.array_view_from_image(medial.GetVectorDistanceOutput())
        self.assertEqual(vectors.shape, (*mask.shape, 3))
        self.assertFalse(vectors[mask == 0].any())
        self.assertTrue(np.linalg.norm(vectors[mask != 0], axis=-1).max() > 1)
        self.assertEqual(medial.GetCounts().objectVoxels, np.count_nonzero(mask))
        counts = medial.GetCounts()
        self.assertEqual(counts.boundCells + counts.geodesicMedialCells, np.count_nonzero(labels >= 2))
        self.assertEqual(counts.geodesicMedialCells, np.count_nonzero(labels == 3))
        self.assertEqual(counts.trivialCells + counts.geodesicNonMedialCells, np.count_nonzero(labels == 1))
        self.assertEqual(counts.candidateCells, np.count_nonzero(labels))
        with self.assertRaises(AttributeError):
            counts.objectVoxels = 1

    def test_thresholds_background_and_units(self):
        values = 7 * blobs("int16")
        expected = itk.medial_voxel_image_filter((values > 0).astype("uint8"), thickness=3.0)
        for options in ({"lower_threshold": 3.5}, {"lower_threshold": 7, "upper_threshold": 7}, {"background_value": 0}):
            with self.subTest(options=options):
                labels = itk.medial_voxel_image_filter(values, thickness=3.0, **options)
                np.testing.assert_array_equal(labels, expected)
        fine = image_of(values, spacing=(0.1, 0.1, 0.1))
        in_voxels = itk.medial_voxel_image_filter(fine, thickness=3.0, use_image_spacing=False)
        np.testing.assert_array_equal(itk.array_view_from_image(in_voxels), expected)

    def test_bounds_change_labels_not_cells(self):
        image = image_of(blobs())
        cells = {}
        for bound in ("FreeSpace", "Off"):
            value = getattr(itk.MedialVoxelEnums, f"PseudoGeodesicBound_{bound}")
            labels = itk.medial_voxel_image_filter(image, thickness=3.0, pseudo_geodesic_bound=value)
            cells[bound] = itk.array_from_image(labels)
        np.testing.assert_array_equal(cells["FreeSpace"] >= 2, cells["Off"] >= 2)
        self.assertFalse((cells["Off"] == 2).any())

    def test_automatic_thickness(self):
        automatic = itk.MedialVoxelEnums.ThicknessMode_Automatic
        mask = np.zeros((40, 60, 60), "uint8")
        mask[6:8, 4:56, 4:56] = 1
        mask[16:26, 4:56, 4:56] = 1
        medial = itk.MedialVoxelImageFilter.New(image_of(mask), thickness_mode=automatic)
        medial.Update()
        cells = itk.array_from_image(medial.GetOutput()) >= 2
        self.assertEqual(medial.GetThicknessMode(), automatic)
        self.assertTrue(cells[6, 20:40, 20:40].all())
        self.assertTrue(cells[20, 20:40, 20:40].all())
        self.assertFalse(cells[[z for z in range(40) if z not in (6, 20)]].any())
        fixed = itk.array_from_image(itk.medial_voxel_image_filter(image_of(mask), thickness=3.0)) >= 2
        self.assertTrue(fixed[17].any(), "branches towards the edges of the thick plate")
        limits = {"minimum_thickness": 3.0, "maximum_thickness": 16.0}
        same = itk.medial_voxel_image_filter(image_of(mask), thickness_mode=automatic, **limits)
        np.testing.assert_array_equal(itk.array_from_image(same) >= 2, cells)

    def test_pores_and_dust(self):
        mask = np.zeros((30, 40, 40), "uint8")
        mask[10:20, 4:36, 4:36] = 1
        expected = itk.array_from_image(itk.medial_voxel_image_filter(image_of(mask), thickness=3.0))
        mask[14, 20, 20:23] = 0
        mask[5, 20, 20] = 1
        medial = itk.MedialVoxelImageFilter.New(image_of(mask), thickness=3.0, maximum_pore_size=3)
        medial.Update()
        np.testing.assert_array_equal(itk.array_from_image(medial.GetOutput()), expected)
        self.assertEqual((medial.GetCounts().filledVoxels, medial.GetCounts().removedVoxels), (3, 1))
        medial.UnsetMaximumPoreSize()
        self.assertEqual(medial.GetMaximumPoreSize(), 0)
        medial.SetThicknessMode(itk.MedialVoxelEnums.ThicknessMode_Automatic)
        self.assertEqual(medial.GetMaximumPoreSize(), 32)

    def test_objects_are_those_of_single_updates(self):
        for name in PIXEL_TYPES:
            with self.subTest(type=name):
                cells = 3 * blobs(name, seed=2)
                cells[blobs(name, seed=3) != 0] = 120
                single = {
                    label: itk.medial_voxel_image_filter((cells == label).astype("uint8"), thickness=3.0)
                    for label in (3, 120)
                }
                medial = itk.MedialVoxelObjectsImageFilter.New(image_of(cells), thickness=3.0)
                medial.Update()
                labels = itk.array_from_image(medial.GetOutput())
                objects = itk.array_from_image(medial.GetObjectOutput())
                # The larger label has the cells where it alone is medial, or where the smaller one has no corner.
                larger = (single[3] == 0) | ((single[3] == 1) & (single[120] >= 2))
                larger &= single[120] > 0
                np.testing.assert_array_equal(labels, np.where(larger, single[120], single[3]))
                np.testing.assert_array_equal(objects, np.where(larger, 120, 3 * (single[3] > 0)))
                self.assertEqual(objects.dtype, cells.dtype)
                self.assertEqual(list(medial.GetFoundLabels()), [3, 120])
                shared = np.count_nonzero((single[3] >= 2) & (single[120] >= 2))
                self.assertEqual(medial.GetNumberOfSharedCells(), shared)
                for label in (3, 120):
                    medial_cells = medial.GetNumberOfMedialCellsWithLabel(label)
                    self.assertEqual(medial_cells, np.count_nonzero(single[label] >= 2))
                    self.assertEqual(medial.GetNumberOfVoxelsWithLabel(label), np.count_nonzero(cells == label))
                from_array = itk.medial_voxel_objects_image_filter(cells, thickness=3.0)
                np.testing.assert_array_equal(from_array, labels)
                chosen = itk.medial_voxel_objects_image_filter(cells, object_labels=[120], thickness=3.0)
                np.testing.assert_array_equal(chosen, single[120])

    def test_streamed_pieces_are_the_whole(self):
        image = image_of(blobs())
        expected = itk.array_from_image(itk.medial_voxel_image_filter(image, thickness=3.0))
        medial = itk.MedialVoxelImageFilter.New(image, thickness=3.0)
        pieces = itk.StreamingImageFilter.New(medial, number_of_stream_divisions=7)
        pieces.Update()
        np.testing.assert_array_equal(itk.array_view_from_image(pieces.GetOutput()), expected)

    def test_help_tells_what_is_needed(self):
        instantiated = itk.MedialVoxelImageFilter[itk.Image[itk.UC, 3], itk.Image[itk.UC, 3]]
        for thing in (itk.MedialVoxelImageFilter, instantiated):
            text = " ".join(pydoc.render_doc(thing).split()).lower()
            for words in ("dual cell", "physical units", "default 3", "Michikawa", "Object (default"):
                self.assertIn(words.lower(), text)
        text = pydoc.render_doc(itk.VectorDistanceMapImageFilter)
        self.assertIn("maximum_distance: ", text)


class NothingToFind(unittest.TestCase):
    def test_image_without_voxels(self):
        image = itk.Image[itk.UC, 3].New()
        image.SetRegions([0, 0, 0])
        image.Allocate()
        labels = itk.medial_voxel_image_filter(image, thickness=3.0)
        self.assertEqual(list(labels.GetLargestPossibleRegion().GetSize()), [0, 0, 0])

    def test_no_object(self):
        labels = itk.medial_voxel_image_filter(np.zeros((8, 9, 10), "uint8"), thickness=3.0)
        self.assertEqual(labels.shape, (8, 9, 10))
        self.assertFalse(labels.any())

    def test_no_background(self):
        medial = itk.MedialVoxelImageFilter.New(image_of(np.ones((8, 9, 10), "uint8")), thickness=3.0)
        medial.Update()
        labels = itk.array_view_from_image(medial.GetOutput())
        self.assertTrue((labels[:-1, :-1, :-1] == 1).all())
        self.assertEqual(medial.GetCounts().trivialCells, 7 * 8 * 9)


if __name__ == "__main__":
    unittest.main()
