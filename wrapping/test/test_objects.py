# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""All objects of a label map in one update, as Python users get them."""

import pathlib
import tempfile
import unittest

import itk
import numpy as np

from support import blobs, image_of, run_program

AUTOMATIC = itk.MedialVoxelEnums.ThicknessMode_Automatic


def label_map(dtype="uint16", shape=(30, 34, 38)):
    """Objects that touch each other, with labels 3, 7 and 120."""
    cells = 3 * blobs(dtype, shape, seed=2)
    cells[blobs(dtype, shape, seed=3) != 0] = 120
    cells[blobs(dtype, shape, seed=4) != 0] = 7
    return cells


def separated(image, **options):
    medial = itk.MedialVoxelObjectsImageFilter.New(image, **options)
    medial.Update()
    return medial


class SeparateObjects(unittest.TestCase):
    def test_results_are_those_of_the_program(self):
        choices = (({"thickness": 1.5}, ["--thickness=1.5"]), ({"thickness_mode": AUTOMATIC}, []))
        for dtype in ("uint8", "int16", "uint16"):
            for options, words in choices:
                with self.subTest(dtype=dtype, options=options), tempfile.TemporaryDirectory() as name:
                    image = image_of(label_map(dtype), spacing=(0.5, 0.5, 0.75))
                    files = ("--labels=all", "--objects=", "--thickness-map=", *words)
                    written = run_program(pathlib.Path(name), image, *files)
                    medial = separated(image, generate_thickness=True, **options)
                    self.assertEqual(itk.array_from_image(medial.GetOutput()).tobytes(), written["labels"].tobytes())
                    self.assertEqual(itk.array_from_image(medial.GetObjectOutput()).tobytes(), written["objects"].tobytes())
                    thickness = itk.array_from_image(medial.GetThicknessOutput())
                    self.assertEqual(thickness.tobytes(), written["thickness-map"].tobytes())

    def test_counts_are_those_of_the_arrays(self):
        cells = label_map()
        medial = separated(image_of(cells), thickness=3.0)
        self.assertEqual(list(medial.GetFoundLabels()), [3, 7, 120])
        for label in (3, 7, 120):
            self.assertEqual(medial.GetNumberOfVoxelsWithLabel(label), np.count_nonzero(cells == label))
            self.assertEqual(medial.GetNumberOfVoxelsWithLabel(np.int64(label)), np.count_nonzero(cells == label))
        self.assertEqual(medial.GetCounts().objectVoxels, np.count_nonzero(cells))
        with self.assertRaises(RuntimeError):
            medial.GetNumberOfVoxelsWithLabel(4)

    def test_objects_that_are_chosen(self):
        cells = label_map()
        chosen = separated(image_of(cells), thickness=3.0, object_labels=[7, 120])
        alone = separated(image_of(np.where(cells == 3, 0, cells).astype("uint16")), thickness=3.0)
        self.assertEqual(list(chosen.GetFoundLabels()), [7, 120])
        for first, second in ((chosen.GetOutput(), alone.GetOutput()), (chosen.GetObjectOutput(), alone.GetObjectOutput())):
            np.testing.assert_array_equal(itk.array_from_image(first), itk.array_from_image(second))

    def test_one_object(self):
        medial = itk.MedialVoxelObjectsImageFilter.New(image_of(label_map()), thickness=3.0)
        medial.SetObjectLabels([7])
        medial.Update()
        self.assertEqual(np.unique(itk.array_from_image(medial.GetObjectOutput())).tolist(), [0, 7])

    def test_plane_images(self):
        cells = label_map(shape=(40, 50))
        medial = separated(image_of(cells), thickness=3.0)
        self.assertEqual(list(medial.GetFoundLabels()), np.unique(cells[cells > 0]).tolist())

    def test_streamed_pieces_are_the_whole(self):
        medial = separated(image_of(label_map()), thickness=3.0)
        expected = itk.array_from_image(medial.GetObjectOutput())
        pieces = itk.StreamingImageFilter.New(medial.GetObjectOutput(), number_of_stream_divisions=7)
        pieces.Update()
        np.testing.assert_array_equal(itk.array_from_image(pieces.GetOutput()), expected)


if __name__ == "__main__":
    unittest.main()
