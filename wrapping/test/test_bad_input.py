# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What cannot be done is an exception that says why, never a crash."""

import unittest

import itk
import numpy as np

from support import blobs, image_of


class BadInput(unittest.TestCase):
    def assert_refused(self, *words, exception=RuntimeError, image=None, function=itk.medial_voxel_image_filter, **options):
        """The call fails with a message that has all words; the next call works."""
        with self.assertRaises(exception) as caught:
            function(blobs() if image is None else image, **options)
        for word in words:
            self.assertIn(word, str(caught.exception))
        self.assertTrue(itk.medial_voxel_image_filter(blobs(), thickness=3.0).any())

    def test_automatic_thickness(self):
        automatic = itk.MedialVoxelEnums.ThicknessMode_Automatic
        self.assert_refused("MinimumThickness is 17", thickness_mode=automatic, minimum_thickness=17.0)
        self.assert_refused("MaximumThickness is -1", thickness_mode=automatic, maximum_thickness=-1.0)

    def test_pore_size(self):
        self.assert_refused("MaximumPoreSize is 1000001", thickness=3.0, maximum_pore_size=1000001)

    def test_thickness(self):
        for thickness in (-1.0, 0.0, float("nan"), float("inf")):
            with self.subTest(thickness=thickness):
                self.assert_refused("Thickness", "positive", thickness=thickness)

    def test_spacing(self):
        for spacing, words in ((1e13, "spacing along axis 0 is 1e+13"), (1e-80, "from 1e-12 to 1e+12")):
            with self.subTest(spacing=spacing):
                self.assert_refused(words, image=image_of(blobs(), [spacing] * 3), thickness=3.0)
        self.assert_refused("must not exceed 1000", image=image_of(blobs(), [1.0, 1.0, 1001.0]), thickness=3.0)

    def test_thresholds(self):
        self.assert_refused("thresholds are 5 and 4", thickness=3.0, lower_threshold=5.0, upper_threshold=4.0)
        self.assert_refused("thresholds", thickness=3.0, lower_threshold=float("nan"))

    def test_objects(self):
        objects = {"function": itk.medial_voxel_objects_image_filter}
        self.assert_refused("must not be set", lower_threshold=1.0, **objects)
        self.assert_refused("ObjectLabels has 256", "from 0 to 255", object_labels=[1, 256], **objects)
        self.assert_refused("No voxel", "label 9", object_labels=[1, 9], **objects)
        self.assert_refused("not a label map", "0.5", image=0.5 * blobs("float32"), **objects)
        self.assert_refused(exception=TypeError, object_labels=[1.5], **objects)

    def test_arguments_of_a_wrong_type(self):
        self.assert_refused(exception=TypeError, thickness="thick")

    def test_unknown_arguments(self):
        self.assert_refused("Thicknes", exception=AttributeError, thicknes=3.0)

    def test_pixel_types_that_are_not_wrapped(self):
        self.assert_refused(exception=(KeyError, TypeError, itk.TemplateTypeError), image=blobs("float64"), thickness=3.0)

    def test_four_dimensions(self):
        self.assert_refused(
            exception=(KeyError, TypeError, RuntimeError, itk.TemplateTypeError),
            image=np.zeros((4, 4, 4, 4), "uint8"),
            thickness=3.0,
        )

    def test_no_input(self):
        with self.assertRaises(RuntimeError) as caught:
            itk.MedialVoxelImageFilter[itk.Image[itk.UC, 3], itk.Image[itk.UC, 3]].New().Update()
        self.assertIn("Primary", str(caught.exception))

    def test_too_little_memory(self):
        self.assert_refused("bytes", thickness=3.0, working_memory_limit=1)

    def test_unequal_arguments_of_the_distance_map(self):
        with self.assertRaises(RuntimeError) as caught:
            itk.vector_distance_map_image_filter(image_of(blobs()), maximum_distance=-2.0)
        self.assertIn("MaximumDistance", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
