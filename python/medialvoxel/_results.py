# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What the functions return."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np


def _describe(array: np.ndarray | None) -> str:
    return "None" if array is None else f"{array.dtype}{list(array.shape)}"


@dataclasses.dataclass(frozen=True, repr=False, eq=False)
class Medial:
    """Medial cells of an array. A cell is the center of 2 x 2 x 2 voxels and stands at the index of its lowest one; the
    last index along each axis longer than 1 has no cell."""

    labels: np.ndarray
    """uint8: 0 no object, 1 not medial, 2 medial by the bound, 3 medial by the search."""
    thickness: np.ndarray | None
    """float32: thickness of the wall at medial cells, negative at unpaired cells (rims, junctions), 0 elsewhere; None when switched off."""
    uncertainty: np.ndarray | None
    """float32: half of the interval that holds the thickness in 95 % of the cases; NaN at medial cells where it is not known, 0
    elsewhere; None when not asked for."""
    vectors: np.ndarray | None
    """float32, with a last axis (z, y, x): from each object voxel to the nearest boundary voxel; None when switched
    off."""
    objects: np.ndarray | None
    """With `labels`: the label of the object of each cell, of the type of the array; otherwise None."""
    counts: dict[str, int]
    """Numbers of voxels and cells, by their names in the report of the program."""
    object_counts: list[dict[str, int]]
    """With `labels`: label, voxels, candidate_cells and medial_cells of each object."""
    origin: tuple[float, ...]
    """Position of the first cell, in the units of the spacing: half a voxel along each axis longer than 1."""
    spacing: tuple[float, ...]
    """That of the array."""
    measure: dict[str, Any]
    """How the thickness was measured, as in the report of the program: `on` "object", "crossings" of the threshold or "fits";
    `scan` with background, material, blur (in voxels) and noise of the values, or None, and the `reason` for that."""
    smoothed: bool
    """Whether the object was smoothed."""
    roughness: float
    """Share of the voxels at the border of the object that stand alone, where smooth="auto" measured it; or 0."""
    max_thickness: float | None
    """The maximum of the automatic thickness that was applied. The default of 16 voxels rises, up to 32, where a quarter
    of the walls or more are thicker. None with a fixed thickness."""
    lower: float | None
    """The lower threshold, also that of Otsu."""

    @property
    def medial(self) -> np.ndarray:
        """bool: the medial cells."""
        return self.labels >= 2

    def __repr__(self) -> str:
        return (
            f"Medial(labels={_describe(self.labels)}, thickness={_describe(self.thickness)}, "
            f"vectors={_describe(self.vectors)}, {self.counts['medial_cells']} medial cells)"
        )


@dataclasses.dataclass(frozen=True, repr=False, eq=False)
class Distances:
    """Vectors and signed distances to the nearest boundary voxel."""

    distance: np.ndarray
    """float32: negative inside the object; NaN beyond `max_distance` and without a boundary."""
    vectors: np.ndarray
    """float32, with a last axis (z, y, x): the displacement."""
    counts: dict[str, int]
    """Numbers of voxels."""
    lower: float | None
    """The lower threshold, also that of Otsu."""

    def __repr__(self) -> str:
        return f"Distances(distance={_describe(self.distance)}, vectors={_describe(self.vectors)})"


@dataclasses.dataclass(frozen=True, repr=False, eq=False)
class LocalThickness:
    """Thickness of walls, or diameters of the largest balls, at the voxels of an object."""

    thickness: np.ndarray
    """float32, in units of the spacing; 0 in the background, NaN in edges and corners that no wall covers."""
    counts: dict[str, int]
    """Numbers of voxels; `voxels_at_maximum` are those cut at `largest_ball`, `voxels_without_wall` those that are NaN."""
    lower: float | None
    """The lower threshold, also that of Otsu."""

    def __repr__(self) -> str:
        return f"LocalThickness(thickness={_describe(self.thickness)}, {self.counts['object_voxels']} object voxels)"


@dataclasses.dataclass(frozen=True, repr=False, eq=False)
class Mesh:
    """The medial surface."""

    points: np.ndarray
    """float64 (n, 3): z, y, x in the units of the spacing; the first voxel of the array is at 0."""
    faces: np.ndarray
    """int64 (m, 4), or (m, 3) where all are triangles: indices of points. A triangle among quadrilaterals has its last
    corner twice."""
    thickness: np.ndarray
    """float32 (n,): thickness of the wall at each point."""
    lower: float | None = None
    """The lower threshold, also that of Otsu."""

    @property
    def triangles(self) -> np.ndarray:
        """int64 (k, 3): the faces, split along the shorter diagonal, that from the first corner when both are as
        long."""
        if self.faces.shape[1] == 3:
            return self.faces
        halves = self._halves()
        return halves[halves[:, 0] != halves[:, 1]]

    def _halves(self) -> np.ndarray:
        """Of all faces; the second half of a triangle begins with one corner twice."""
        corners = self.points[self.faces]
        first = np.sum((corners[:, 0] - corners[:, 2]) ** 2, axis=1)
        second = np.sum((corners[:, 1] - corners[:, 3]) ** 2, axis=1)
        is_first = (first <= second) | self._are_triangles
        halves = np.where(
            is_first[:, None, None], [[0, 1, 2], [2, 3, 0]], [[1, 2, 3], [3, 0, 1]]
        )
        return np.take_along_axis(self.faces, halves.reshape(len(self.faces), 6), axis=1).reshape(-1, 3)

    @property
    def _are_triangles(self) -> np.ndarray:
        return self.faces[:, -1] == self.faces[:, -2]

    @property
    def points_xyz(self) -> np.ndarray:
        """float64 (n, 3): the points as x, y, z, the order of viewers and of files of meshes."""
        return np.ascontiguousarray(self.points[:, ::-1])

    def to_pyvista(self) -> Any:
        """As pyvista.PolyData, x first, with the point data "thickness". Needs pyvista."""
        import pyvista

        corners = self.faces.shape[1] - self._are_triangles[:, None]
        cells = np.hstack((corners, self.faces))
        is_corner = np.arange(cells.shape[1]) <= corners
        surface = pyvista.PolyData(self.points_xyz, cells[is_corner])
        surface.point_data["thickness"] = self.thickness
        return surface

    def to_meshio(self) -> Any:
        """As meshio.Mesh, x first, with the point data "thickness". Needs meshio."""
        import meshio

        if self.faces.shape[1] == 3:
            cells = [("triangle", self.faces)]
        else:
            triangles = self._are_triangles
            cells = [("quad", self.faces[~triangles]), ("triangle", self.faces[triangles, :3])]
        return meshio.Mesh(
            self.points_xyz, [(kind, faces) for kind, faces in cells if len(faces)], point_data={"thickness": self.thickness}
        )

    def to_trimesh(self) -> Any:
        """As trimesh.Trimesh of triangles, x first, with the vertex attribute "thickness". Needs trimesh."""
        import trimesh

        return trimesh.Trimesh(
            self.points_xyz, self.triangles, vertex_attributes={"thickness": self.thickness}, process=False
        )

    def __repr__(self) -> str:
        return f"Mesh({len(self.points)} points, {len(self.faces)} faces of {self.faces.shape[1]} corners)"
