# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Meshes in the libraries that people use, each of which is skipped where it is not installed."""

import importlib.util
import unittest

import medialvoxel
import numpy as np

from support import scene

needs = lambda name: unittest.skipUnless(importlib.util.find_spec(name), f"skipped: no {name}")  # noqa: E731


def plate(is_round=False):
    """Of 4 x 34 x 34 voxels, or a disc of that diameter, whose elements cannot all be quadrilaterals."""
    y, x = np.mgrid[:40, :40] - 19.5
    result = np.zeros((12, 40, 40), np.uint8)
    result[4:8] = x**2 + y**2 < 17**2 if is_round else np.maximum(abs(x), abs(y)) < 17
    return result


class Meshes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mesh = medialvoxel.mesh(scene(), lower=40, spacing=(2.0, 1.0, 0.5))

    def area(self):
        """Of all triangles, by the cross product."""
        corners = self.mesh.points_xyz[self.mesh.triangles]
        return np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2

    def test_triangles_are_those_of_the_library(self):
        split = medialvoxel.mesh(scene(), lower=40, spacing=(2.0, 1.0, 0.5), triangles=True)
        np.testing.assert_array_equal(self.mesh.triangles, split.faces)
        self.assertIs(split.triangles, split.faces)

    def test_points_lie_in_the_array(self):
        self.assertTrue((self.mesh.points >= 0).all())
        self.assertTrue((self.mesh.points <= np.array([2.0, 1.0, 0.5]) * (np.array(scene().shape) - 1)).all())

    def test_a_sheet_at_every_second_voxel(self):
        stripes = np.indices((96, 96, 96)).sum(0) % 6 < 3
        self.assertGreater(len(medialvoxel.mesh(stripes).points), 96**3 / 3)
        with self.assertRaisesRegex(MemoryError, "more cells than fit into the memory that is allowed"):
            medialvoxel.mesh(stripes, thickness=3, memory="20M")

    def test_an_empty_mesh(self):
        empty = medialvoxel.mesh(np.zeros((4, 4, 4)))
        self.assertEqual((empty.points.shape, empty.faces.shape, empty.triangles.shape), ((0, 3), (0, 4), (0, 3)))

    def test_elements_of_a_size(self):
        for is_round, expected in (False, 30**2), (True, np.pi * 15**2):
            fine, coarse = (medialvoxel.mesh(plate(is_round), element_size=size) for size in ("voxel", "auto"))
            self.assertLess(8 * len(coarse.faces), len(fine.faces))
            self.assertEqual(coarse.faces.shape[1], 4)
            triangles = coarse.faces[:, 2] == coarse.faces[:, 3]
            self.assertFalse(triangles.all())
            self.assertEqual(triangles.any(), is_round)
            self.assertEqual(len(coarse.triangles), 2 * len(coarse.faces) - triangles.sum())
            corners = coarse.points[coarse.triangles]
            areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
            self.assertGreater(areas.min(), 1)
            self.assertAlmostEqual(areas.sum() / expected, 1, delta=0.05)
        alone = medialvoxel.mesh(plate(), element_size=5.0, triangles=True)
        self.assertEqual(alone.faces.shape[1], 3)
        empty = medialvoxel.mesh(np.zeros((4, 4, 4)), element_size="auto")
        self.assertEqual(len(empty.faces), 0)
        for size in (0.5, 0, -1, "large", float("nan")):
            with self.assertRaisesRegex(ValueError, str(size)):
                medialvoxel.mesh(plate(), element_size=size)

    @needs("pyvista")
    def test_elements_of_a_size_in_pyvista(self):
        mesh = medialvoxel.mesh(plate(is_round=True), element_size="auto")
        surface = mesh.to_pyvista()
        self.assertEqual(surface.n_cells, len(mesh.faces))
        sizes = {surface.get_cell(k).n_points for k in range(surface.n_cells)}
        self.assertEqual(sizes, {3, 4})
        self.assertAlmostEqual(surface.area / (np.pi * 15**2), 1, delta=0.05)
        quality = surface.cell_quality("scaled_jacobian").cell_data["scaled_jacobian"]
        self.assertGreater(quality.min(), 0)

    @needs("pyvista")
    def test_pyvista(self):
        surface = self.mesh.to_pyvista()
        self.assertEqual((surface.n_points, surface.n_cells), (len(self.mesh.points), len(self.mesh.faces)))
        np.testing.assert_array_equal(surface.point_data["thickness"], self.mesh.thickness)
        np.testing.assert_allclose(surface.points, self.mesh.points[:, ::-1])
        self.assertTrue(surface.is_all_triangles is False or surface.n_cells == 0)

    @needs("meshio")
    def test_meshio(self):
        mesh = self.mesh.to_meshio()
        np.testing.assert_array_equal(mesh.cells_dict["quad"], self.mesh.faces)
        np.testing.assert_array_equal(mesh.point_data["thickness"], self.mesh.thickness)

    @needs("trimesh")
    def test_trimesh(self):
        mesh = self.mesh.to_trimesh()
        self.assertEqual(len(mesh.vertices), len(self.mesh.points))
        self.assertAlmostEqual(mesh.area / self.area(), 1.0, 9)
        np.testing.assert_array_equal(mesh.vertex_attributes["thickness"], self.mesh.thickness)


if __name__ == "__main__":
    unittest.main()
