# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The mesh of the medial surface as Python users get it."""

import unittest

import itk
import numpy as np

from support import image_of, plate


def surface_of(image, **options):
    """Points as an array, thickness by point, number of faces."""
    surface = itk.MedialSurfaceMeshFilter.New(image, **options)
    surface.Update()
    mesh = surface.GetOutput()
    points = np.array([list(mesh.GetPoint(i)) for i in range(mesh.GetNumberOfPoints())])
    thickness = np.array([mesh.GetPointData().GetElement(i) for i in range(mesh.GetNumberOfPoints())])
    return points, thickness, mesh.GetNumberOfCells()


class Surface(unittest.TestCase):
    def test_a_plate_is_midway_and_as_thick_as_it_is(self):
        spacing = (0.5, 0.5, 0.5)
        mask = plate(thickness=4)
        across = np.argwhere(mask)[:, 1]
        middle = (across.min() + across.max()) / 2 * spacing[1]
        for options in ({"thickness": 1.5}, {"thickness_mode": itk.MedialVoxelEnums.ThicknessMode_Automatic}):
            with self.subTest(options=options):
                points, thickness, faces = surface_of(image_of(mask, spacing=spacing), **options)
                self.assertGreater(faces, 100)
                self.assertLess(np.abs(points[:, 1] - middle).max(), 0.05)
                np.testing.assert_allclose(np.median(thickness), 4 * spacing[1], rtol=1e-6)

    def test_triangles_are_twice_as_many(self):
        image = image_of(plate(thickness=3))
        _, _, quads = surface_of(image, thickness=3.0)
        _, _, triangles = surface_of(image, thickness=3.0, generate_triangles=True)
        self.assertEqual(triangles, 2 * quads)

    def test_gray_values_move_the_points(self):
        distance = np.add.outer(np.arange(40) * 0.6, np.arange(30) * 0.8)[:, :, None] - 22.3
        blurred = 1 / (1 + np.exp(3 * (np.abs(distance) - 2.2))) + np.zeros((40, 30, 20))
        image = image_of(blurred.astype("float32"))
        means = []
        for gray in (False, True):
            points, thickness, _ = surface_of(image, thickness=3.0, lower_threshold=0.5, subvoxel_thickness=gray)
            means.append(np.abs(points[:, 2] * 0.6 + points[:, 1] * 0.8 - 22.3).mean())
            self.assertLess(abs(np.median(thickness) - 4.4), 0.5)
        self.assertLess(means[1], min(0.02, means[0]))

    def test_branches_are_left_out(self):
        mask = np.zeros((24, 26, 34), "uint8")
        mask[3:6, 3:23, 3:31] = 1
        mask[3:16, 3:23, 16:19] = 1
        image = image_of(mask)
        _, _, faces = surface_of(image, thickness=3.0)
        _, _, all_faces = surface_of(image, thickness=3.0, minimum_branch_length=5.0)
        _, _, fewer = surface_of(image, thickness=3.0, minimum_branch_length=12.0)
        self.assertEqual(all_faces, faces)
        self.assertLess(fewer, faces - 100)
        with self.assertRaisesRegex(RuntimeError, "MinimumBranchLength is -1"):
            surface_of(image, thickness=3.0, minimum_branch_length=-1.0)

    def test_an_empty_image_has_an_empty_mesh(self):
        points, _, faces = surface_of(image_of(np.zeros((8, 8, 8), "uint8")), thickness=3.0)
        self.assertEqual((len(points), faces), (0, 0))

    def test_a_wrong_thickness_is_named(self):
        with self.assertRaisesRegex(RuntimeError, "Thickness is -1"):
            surface_of(image_of(plate(thickness=3)), thickness=-1.0)


if __name__ == "__main__":
    unittest.main()
