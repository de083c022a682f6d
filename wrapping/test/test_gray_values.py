# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Thickness by fits to gray values, its uncertainty, and smoothing, as Python users get them."""

import pathlib
import tempfile
import unittest

import itk
import numpy as np

from support import WALLS, blobs, image_of, run_program, scan

AUTOMATIC = itk.MedialVoxelEnums.ThicknessMode_Automatic


def measured(image, **options):
    """The filter after its update, and its labels, thickness and uncertainty as arrays."""
    options = {"lower_threshold": 60, "thickness_mode": AUTOMATIC, "subvoxel_thickness": True, **options}
    medial = itk.MedialVoxelImageFilter.New(image, generate_thickness=True, generate_uncertainty=True, **options)
    medial.Update()
    outputs = (medial.GetOutput(), medial.GetThicknessOutput(), medial.GetUncertaintyOutput())
    return medial, *(itk.array_from_image(output) for output in outputs)


def middle(array, begin, thickness):
    """The part of the result in a wall, away from its rims."""
    return array[begin - 1 : begin + thickness + 1, 12:-12, 12:-12]


class GrayValues(unittest.TestCase):
    def test_the_scan_is_found(self):
        medial, *_ = measured(image_of(scan()))
        found = medial.GetScan()
        self.assertEqual(found.reason, "")
        self.assertAlmostEqual(found.background, 10, delta=0.5)
        self.assertAlmostEqual(found.material, 110, delta=1.5)
        self.assertAlmostEqual(found.blur, 0.8, delta=0.05)
        self.assertAlmostEqual(found.noise, 1.5, delta=0.3)

    def test_thickness_is_right_and_the_uncertainty_holds_the_error(self):
        for scale in (1.0, 0.25):
            image = image_of(scan(), spacing=(scale,) * 3)
            _, labels, values, uncertainty = measured(image)
            for begin, thickness in WALLS.items():
                with self.subTest(thickness=thickness, spacing=scale):
                    cells = middle(labels, begin, thickness) >= 2
                    error = middle(values, begin, thickness)[cells] / scale - thickness
                    half = middle(uncertainty, begin, thickness)[cells] / scale
                    self.assertGreater(cells.sum(), 400)
                    self.assertLess(abs(np.median(error)), 0.05)
                    self.assertGreater(np.mean(abs(error) <= half), 0.9)
                    self.assertLess(np.median(half), 0.3)
            self.assertFalse(uncertainty[labels < 2].any())

    def test_levels_that_are_set(self):
        image = image_of(scan())
        medial, _, values, _ = measured(image, scan_levels=(np.float32(10), 110))
        self.assertEqual((medial.GetScan().background, medial.GetScan().material), (10, 110))
        medial.SetScanLevels(10, 150)
        medial.Update()
        # A higher material explains the thin wall by a thinner one.
        other = itk.array_from_image(medial.GetThicknessOutput())
        self.assertLess(np.median(middle(other, 4, 2)[middle(other, 4, 2) > 0]), np.median(middle(values, 4, 2)[middle(values, 4, 2) > 0]))
        medial.UnsetScanLevels()
        medial.Update()
        self.assertAlmostEqual(medial.GetScan().material, 110, delta=1.5)
        for levels in ((5, 5), (float("nan"), 1), (0, float("inf"))):
            with self.subTest(levels=levels), self.assertRaises(RuntimeError) as caught:
                measured(image, scan_levels=levels)
            self.assertIn("ScanLevels: the values of background and material", str(caught.exception))

    def test_why_there_is_no_scan(self):
        medial, labels, values, uncertainty = measured(image_of(100 * blobs("float32")))
        self.assertNotEqual(medial.GetScan().reason, "")
        self.assertEqual(medial.GetScan().blur, 0)
        self.assertTrue(np.isnan(uncertainty[labels >= 2]).all())
        self.assertTrue((values[labels >= 2] != 0).all())

    def test_what_does_not_go_together(self):
        image = image_of(scan())
        for options in ({"subvoxel_thickness": False}, {"lower_threshold": float("nan")}):
            with self.subTest(options=options), self.assertRaises(RuntimeError):
                measured(image, **options)
        without = itk.MedialVoxelImageFilter.New(image, subvoxel_thickness=True)
        self.assertRaises(RuntimeError, without.Update)

    def test_the_uncertainty_comes_and_goes(self):
        medial = itk.MedialVoxelImageFilter.New(image_of(scan()), lower_threshold=60, subvoxel_thickness=True)
        self.assertIsNone(medial.GetUncertaintyOutput())
        medial.GenerateUncertaintyOn()
        medial.Update()
        self.assertEqual(list(medial.GetUncertaintyOutput().GetOrigin()), list(medial.GetOutput().GetOrigin()))
        medial.GenerateUncertaintyOff()
        self.assertIsNone(medial.GetUncertaintyOutput())

    def test_streamed_pieces_are_the_whole(self):
        image = image_of(scan())
        medial, _, _, expected = measured(image)
        pieces = itk.StreamingImageFilter.New(medial.GetUncertaintyOutput(), number_of_stream_divisions=5)
        pieces.Update()
        np.testing.assert_array_equal(itk.array_from_image(pieces.GetOutput()), expected)

    def test_meshes_have_the_thickness_of_the_fits(self):
        surface = itk.medial_surface_mesh_filter(
            image_of(scan()), lower_threshold=60, thickness_mode=AUTOMATIC, subvoxel_thickness=True, scan_levels=(10, 110)
        )
        found = []
        for i in range(surface.GetNumberOfPoints()):
            x, y, z = surface.GetPoint(i)
            if abs(z - 4.5) < 1 and 12 < x < 48 and 12 < y < 32:
                found.append(surface.GetPointData().GetElement(i))
        self.assertGreater(len(found), 400)
        self.assertLess(abs(np.median(found) - 2), 0.1)


class SameAsTheProgram(unittest.TestCase):
    def test_fits_and_their_uncertainty(self):
        for dtype in ("float32", "uint8"):
            image = image_of(scan(dtype), spacing=(0.5, 0.5, 0.75))
            for options, words in (({}, []), ({"scan_levels": (5, 120)}, ["--materials=5,120"])):
                with self.subTest(dtype=dtype, options=options), tempfile.TemporaryDirectory() as name:
                    files = ("--lower=60", "--thickness-map=", "--uncertainty-map=", *words)
                    written = run_program(pathlib.Path(name), image, *files)
                    _, labels, values, uncertainty = measured(image, **options)
                    self.assertEqual(labels.tobytes(), written["labels"].tobytes())
                    self.assertEqual(values.tobytes(), written["thickness-map"].tobytes())
                    self.assertEqual(uncertainty.tobytes(), written["uncertainty-map"].tobytes())

    def test_smoothing(self):
        enums = itk.MedialVoxelEnums
        choices = {"auto": enums.Smoothing_Automatic, "on": enums.Smoothing_On, "off": enums.Smoothing_Off}
        for noise, is_rough in ((1.5, False), (30.0, True)):
            image = image_of(scan(noise=noise))
            found = {}
            for name, value in choices.items():
                with self.subTest(noise=noise, smoothing=name), tempfile.TemporaryDirectory() as folder:
                    written = run_program(pathlib.Path(folder), image, "--lower=60", f"--smooth={name}")
                    medial = itk.MedialVoxelImageFilter.New(
                        image, lower_threshold=60, thickness_mode=AUTOMATIC, smoothing=value
                    )
                    medial.Update()
                    found[name] = itk.array_from_image(medial.GetOutput())
                    self.assertEqual(found[name].tobytes(), written["labels"].tobytes())
                    self.assertEqual(medial.GetObjectIsSmoothed(), name == "on" or (name == "auto" and is_rough))
            if not found:
                self.skipTest("the program is not built")
            np.testing.assert_array_equal(found["auto"], found["on" if is_rough else "off"])
            self.assertTrue((found["on"] != found["off"]).any())

    def test_smoothing_is_that_of_the_mode_until_it_is_set(self):
        medial = itk.MedialVoxelImageFilter.New(image_of(scan()), lower_threshold=60)
        self.assertEqual(medial.GetSmoothing(), itk.MedialVoxelEnums.Smoothing_Off)
        medial.SetThicknessMode(AUTOMATIC)
        self.assertEqual(medial.GetSmoothing(), itk.MedialVoxelEnums.Smoothing_Automatic)
        medial.SetSmoothing(itk.MedialVoxelEnums.Smoothing_On)
        medial.UnsetSmoothing()
        self.assertEqual(medial.GetSmoothing(), itk.MedialVoxelEnums.Smoothing_Automatic)


if __name__ == "__main__":
    unittest.main()
