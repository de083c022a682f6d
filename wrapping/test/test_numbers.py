# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Numbers of Python and of NumPy are what setters take, by functions, by New() and by methods; others are errors."""

import unittest

import itk
import numpy as np

from support import blobs, image_of, plate

REALS = (3, 3.0, np.float64(3), np.float32(3), np.float16(3), np.int64(3), np.uint8(3), np.array(3.0), np.array(3))
INTEGERS = (3, np.int64(3), np.int32(3), np.uint8(3), np.uint64(3), np.array(3))

# Functions, names of their enumerations, and one of the numbers that there are and an end of the message.
ENUMERATIONS = [
    (itk.medial_voxel_image_filter, "thickness_mode", 1, "it must be 0 (Fixed) or 1 (Automatic)."),
    (itk.medial_voxel_image_filter, "smoothing", 1, "it must be 0 (Off), 1 (On) or 2 (Automatic)."),
    (itk.medial_voxel_image_filter, "pseudo_geodesic_bound", 2, "it must be 0 (FreeSpace), 1 (Paper) or 2 (Off)."),
    (itk.medial_voxel_image_filter, "vector_distance_boundary", 1, "it must be 0 (Object) or 1 (Background)."),
    (itk.vector_distance_map_image_filter, "boundary", 1, "it must be 0 (Object) or 1 (Background)."),
    (itk.vector_distance_map_image_filter, "region", 0, "it must be 0 (Inside), 1 (Outside) or 2 (Both)."),
    (itk.medial_surface_mesh_filter, "thickness_mode", 0, "it must be 0 (Fixed) or 1 (Automatic)."),
    (itk.medial_surface_mesh_filter, "smoothing", 2, "it must be 0 (Off), 1 (On) or 2 (Automatic)."),
]


class Enumerations(unittest.TestCase):
    def test_others_are_errors(self):
        for function, name, valid, message in ENUMERATIONS:
            for value in (3, 99, 255, np.int64(99)):
                with self.subTest(function=function.__name__, name=name, value=value):
                    with self.assertRaises(RuntimeError) as caught:
                        function(plate(), **{name: value})
                    self.assertIn(f" is {value}; {message}", str(caught.exception))

    def test_numbers_that_do_not_fit_are_not_cut(self):
        for function, name, valid, _ in ENUMERATIONS:
            for value in (256 + valid, valid - 256, 2**32 + valid, 2**70):
                with self.subTest(function=function.__name__, name=name, value=value), self.assertRaises(OverflowError):
                    function(plate(), **{name: value})

    def test_what_is_no_number(self):
        for function, name, _, _ in ENUMERATIONS:
            for value in ("auto", None, 0.5, np.float32(0.5), 1j):
                with self.subTest(function=function.__name__, name=name, value=value), self.assertRaises(TypeError):
                    function(plate(), **{name: value})

    def test_those_that_there_are(self):
        for function, name, valid, _ in ENUMERATIONS:
            for value in (valid, np.int64(valid), np.uint8(valid)):
                with self.subTest(function=function.__name__, name=name, value=value):
                    function(plate(), **{name: value})

    def test_a_refused_number_changes_nothing(self):
        medial = itk.MedialVoxelImageFilter.New(image_of(plate()), thickness_mode=1)
        with self.assertRaises(RuntimeError):
            medial.SetThicknessMode(99)
        self.assertEqual(medial.GetThicknessMode(), itk.MedialVoxelEnums.ThicknessMode_Automatic)


class Numbers(unittest.TestCase):
    def test_real_numbers(self):
        mask = blobs()
        expected = itk.medial_voxel_image_filter(mask, thickness=3.0)
        for value in REALS:
            with self.subTest(type=type(value)):
                np.testing.assert_array_equal(itk.medial_voxel_image_filter(mask, thickness=value), expected)
                medial = itk.MedialVoxelImageFilter.New(image_of(mask), thickness=value, lower_threshold=value)
                self.assertEqual((medial.GetThickness(), medial.GetLowerThreshold()), (3.0, 3.0))
                medial.SetUpperThreshold(value)
                self.assertEqual(medial.GetUpperThreshold(), 3.0)
        medial.SetScanLevels(np.float32(1), np.int16(2))

    def test_values_are_not_rounded(self):
        vectors = itk.VectorDistanceMapImageFilter.New(image_of(blobs()))
        for value in (np.float32(0.1), np.float64(0.1), np.float16(2.5)):
            vectors.SetMaximumDistance(value)
            self.assertEqual(vectors.GetMaximumDistance(), float(value))

    def test_integers(self):
        for value in INTEGERS:
            with self.subTest(type=type(value)):
                medial = itk.MedialVoxelImageFilter.New(image_of(blobs()), maximum_pore_size=value)
                self.assertEqual(medial.GetMaximumPoreSize(), 3)
                medial.SetBackgroundValue(value)
                self.assertEqual(medial.GetBackgroundValue(), 3)
        surface = itk.MedialSurfaceMeshFilter.New(image_of(blobs()), smallest_component=np.int64(7))
        self.assertEqual(surface.GetSmallestComponent(), 7)

    def test_booleans(self):
        medial = itk.MedialVoxelImageFilter.New(image_of(plate()))
        for value in (np.bool_(True), True, np.array(True), np.True_):
            medial.SetGenerateThickness(False)
            medial.SetGenerateThickness(value)
            self.assertIs(medial.GetGenerateThickness(), True)
        medial.SetGenerateThickness(np.bool_(False))
        self.assertIs(medial.GetGenerateThickness(), False)
        itk.medial_voxel_image_filter(plate(), generate_thickness=np.bool_(True))
        for value in (1, 0.0, np.int8(1), np.float32(0), np.array([True, False]), "True", None):
            with self.subTest(value=repr(value)), self.assertRaises(TypeError):
                medial.SetGenerateThickness(value)

    def test_labels(self):
        cells = np.zeros((20, 20, 20), np.uint8)
        cells[2:18, 2:18, 2:8] = 2
        cells[2:18, 2:18, 10:18] = 5
        expected = itk.medial_voxel_objects_image_filter(cells, object_labels=[2, 5], thickness=3.0)
        for labels in ((2, 5), np.array([2, 5]), np.array([2, 5], np.uint8), np.unique(cells[cells > 0]), [np.int16(2), 5]):
            with self.subTest(labels=repr(labels)):
                found = itk.medial_voxel_objects_image_filter(cells, object_labels=labels, thickness=3.0)
                np.testing.assert_array_equal(found, expected)

    def test_what_does_not_fit(self):
        medial = itk.MedialVoxelImageFilter.New(image_of(blobs()))
        for set_value in (medial.SetMaximumPoreSize, medial.SetBackgroundValue):
            with self.assertRaises(OverflowError):
                set_value(-1)
            for value in (2.5, np.float32(2.5), "3", None, [1, 2], np.array([1, 2])):
                with self.subTest(value=repr(value)), self.assertRaises(TypeError):
                    set_value(value)
        for value in ("3", None, 1j, np.array([1.0, 2.0])):
            with self.subTest(value=repr(value)), self.assertRaises(TypeError):
                medial.SetThickness(value)


if __name__ == "__main__":
    unittest.main()
