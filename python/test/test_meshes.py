# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Meshes in the libraries that people use, each of which is skipped where it is not installed."""

import importlib.util
import unittest

import medialvoxel
import numpy as np

from support import scene

needs = lambda name: unittest.skipUnless(importlib.util.find_spec(name), f"skipped: no {name}")  # noqa: E731


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

    def test_an_empty_mesh(self):
        empty = medialvoxel.mesh(np.zeros((4, 4, 4)))
        self.assertEqual((empty.points.shape, empty.faces.shape, empty.triangles.shape), ((0, 3), (0, 4), (0, 3)))

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
