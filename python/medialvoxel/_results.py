# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What the functions return."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._voxels import thin


class _Outputs:
    """What results have in common: an output that was not asked for is no attribute, and its error says how to ask."""

    _ASKED_BY: ClassVar[dict[str, str]] = {}
    counts: dict[str, int]

    def __post_init__(self) -> None:
        for name in self._ASKED_BY:
            if getattr(self, name) is None:
                object.__delattr__(self, name)

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            hint = f"; ask for it by {self._ASKED_BY[name]}" if name in self._ASKED_BY else ""
            raise AttributeError(f"this {type(self).__name__} has no {name}{hint}")

    def __repr__(self) -> str:
        arrays = {name: value for name, value in vars(self).items() if isinstance(value, np.ndarray)}
        described = ", ".join(f"{name}={array.dtype}{list(array.shape)}" for name, array in arrays.items())
        main = next(name for name in ("medial_cells", "object_voxels") if name in self.counts)
        return f"{type(self).__name__}({described}, {self.counts[main]} {main.replace('_', ' ')})"


@dataclasses.dataclass(frozen=True, repr=False, eq=False)
class Medial(_Outputs):
    """Medial cells of an array.

    A cell is the center of 2 x 2 x 2 voxels and stands at the index of its lowest one; the last index along each axis longer
    than 1 has no cell. Arrays have a value for each cell. An output that was not asked for is no attribute.

    Attributes
    ----------
    labels : NDArray[uint8]
        0 no object, 1 not medial, 2 medial by the bound, 3 medial by the search, 4 added for the topology.
    thickness : NDArray[float32]
        Thickness of the wall at medial cells where it was measured, greater than 0; 0 elsewhere, also at `rims`. Not with
        ``thickness_map=False``.
    rims : NDArray[bool]
        Medial cells without a thickness: the unpaired ones, at rims and junctions, and walls that blur has joined. The file of
        the program has negative numbers there. Not with ``thickness_map=False``.
    uncertainty : NDArray[float32]
        Half of the interval that holds the thickness in 95 % of the cases; NaN at medial cells where it is not known, 0
        elsewhere. With ``uncertainty=True``.
    importance : NDArray[float32]
        Length of the shortest path on the boundary between the two points that decide a cell, at most pi / 2 times the largest
        thickness; 0 at trivial cells. The cells from pi / 2 times a thickness on are the medial cells for that thickness. With
        ``importance=True``.
    vectors : NDArray[float32]
        With a last axis (z, y, x): from each object voxel to the nearest boundary voxel. With ``vectors=True``.
    objects : NDArray
        The label of the object of each cell, of the type of the array. With ``labels``.
    counts : dict[str, int]
        Numbers of voxels and cells, by their names in the report of the program.
    topology : dict[str, Any] or None
        With ``same_topology=True``: `added_cells`, and the numbers of `parts`, `tunnels` and `cavities` of the `object` and of the
        `sheet`, which is all cells of the labels 2, 3 and 4; sums over objects with ``labels``.
    object_counts : list[dict[str, int]]
        With ``labels``: label, voxels, candidate_cells and medial_cells of each object, with ``same_topology=True`` also
        added_cells.
    origin : tuple[float, ...]
        Position of the first cell, in the units of the spacing: half a voxel along each axis longer than 1.
    spacing : tuple[float, ...]
        That of the array.
    measure : dict[str, Any]
        How the thickness was measured, as in the report of the program: `on` "object", "crossings" of the threshold or "fits";
        `scan` with background, material, blur (in voxels) and noise of the values, or None, and the `reason` for that.
    smoothed : bool
        Whether the object was smoothed.
    roughness : float
        Share of the voxels at the border of the object that stand alone, where ``smooth="auto"`` measured it; or 0.
    max_thickness : float or None
        The maximum of the automatic thickness that was applied. The default of 16 voxels rises, up to 32, where a quarter of the
        walls or more are thicker. None with a fixed thickness.
    lower : float or None
        The lower threshold, also that of Otsu.
    """

    _ASKED_BY = {
        "thickness": "thickness_map=True",
        "rims": "thickness_map=True",
        "uncertainty": "uncertainty=True",
        "importance": "importance=True, without labels",
        "vectors": "vectors=True, without labels",
        "objects": "labels",
    }

    labels: NDArray[np.uint8]
    thickness: NDArray[np.float32]
    rims: NDArray[np.bool_]
    uncertainty: NDArray[np.float32]
    importance: NDArray[np.float32]
    vectors: NDArray[np.float32]
    objects: NDArray[Any]
    counts: dict[str, int]
    topology: dict[str, Any] | None
    object_counts: list[dict[str, int]]
    origin: tuple[float, ...]
    spacing: tuple[float, ...]
    measure: dict[str, Any]
    smoothed: bool
    roughness: float
    max_thickness: float | None
    lower: float | None

    @property
    def medial(self) -> NDArray[np.bool_]:
        """bool: the medial cells, without those that were added."""
        found: NDArray[np.bool_] = (self.labels == 2) | (self.labels == 3)
        return found

    def voxels(self, mask: ArrayLike) -> NDArray[np.bool_]:
        """The sheet as voxels of a mask, for those who expect the answer of `skimage.morphology.skeletonize`.

        Of the 8 voxels of each medial cell it has one at least, where the mask has any of them. It is one voxel thick but where
        sheets meet or bend within a voxel, and has the parts, tunnels and cavities of the voxels of all medial cells.

        Parameters
        ----------
        mask : ArrayLike
            What is not 0 may be in the sheet: the array, if it was one of 0 and other values, or ``array >= sheet.lower``.
        """
        inside = np.asarray(mask) != 0
        if inside.shape != self.labels.shape:
            raise ValueError(f"the mask has the shape {inside.shape}; it must be that of the sheet, {self.labels.shape}")
        from ._arrays import distance

        depth = distance(inside, spacing=self.spacing, boundary="background", region="inside").distance
        shape = (1,) * (3 - inside.ndim) + inside.shape
        parts = (np.reshape(part, shape) for part in (self.medial, inside, -depth))
        return thin(*parts).reshape(inside.shape).copy()


@dataclasses.dataclass(frozen=True, repr=False, eq=False)
class Distances(_Outputs):
    """Signed distances, and perhaps vectors, to the nearest boundary voxel of each voxel.

    Attributes
    ----------
    distance : NDArray[float32]
        Negative inside the object; NaN beyond `max_distance` and without a boundary.
    vectors : NDArray[float32]
        With a last axis (z, y, x): the displacement. With ``vectors=True``.
    counts : dict[str, int]
        Numbers of voxels.
    lower : float or None
        The lower threshold, also that of Otsu.
    """

    _ASKED_BY = {"vectors": "vectors=True"}

    distance: NDArray[np.float32]
    vectors: NDArray[np.float32]
    counts: dict[str, int]
    lower: float | None


@dataclasses.dataclass(frozen=True, repr=False, eq=False)
class LocalThickness(_Outputs):
    """Thickness of walls, or diameters of the largest balls, at the voxels of an object.

    Attributes
    ----------
    thickness : NDArray[float32]
        In units of the spacing; 0 in the background, NaN in edges and corners that no wall covers.
    counts : dict[str, int]
        Numbers of voxels; `voxels_at_maximum` are those cut at `largest_ball`, `voxels_without_wall` those that are NaN.
    lower : float or None
        The lower threshold, also that of Otsu.
    """

    thickness: NDArray[np.float32]
    counts: dict[str, int]
    lower: float | None


@dataclasses.dataclass(frozen=True)
class Place:
    """Connected medial cells whose walls are too thin.

    Attributes
    ----------
    area : float
        Of the sheet, in squared units of the spacing; of 2 axes a length.
    area_beyond_limit : float
        Of the cells thinner than the limit.
    cells : int
        Number of cells.
    minimum, mean, maximum : float
        Of the thickness.
    center : tuple[float, ...]
        Position (z, y, x) of the thinnest cell; the first voxel of the array is at 0.
    index : tuple[int, ...]
        Index of that cell.
    sides : tuple[tuple[float, ...], tuple[float, ...]]
        Positions of the nearest voxels of the background on both sides of the wall there.
    first, last : tuple[int, ...]
        Smallest and largest index of the cells along each axis.
    uncertainty : float | None
        Half of the 95 % interval of the minimum; None: not known.
    at_edge : bool
        Whether the wall there reaches the edge of the array, so that a part of it may be missing.
    """

    area: float
    area_beyond_limit: float
    cells: int
    minimum: float
    mean: float
    maximum: float
    center: tuple[float, ...]
    index: tuple[int, ...]
    sides: tuple[tuple[float, ...], tuple[float, ...]]
    first: tuple[int, ...]
    last: tuple[int, ...]
    uncertainty: float | None
    at_edge: bool


@dataclasses.dataclass(frozen=True)
class Places:
    """Places with too thin walls.

    Attributes
    ----------
    limit, grow_limit : float
        Each place has a cell thinner than the limit; all of its cells are thinner than the second one.
    min_place_area : float
        Area beyond the limit of the smallest place that counts.
    number, cells : int
        Of places, and of their cells, also of those that are not listed.
    area, area_beyond_limit : float
        Of all of them.
    share_of_sheet : float
        `area_beyond_limit`, of the area of the sheet.
    worst : float | None
        Thickness of the thinnest listed place; None without places.
    smaller : int
        Places that are left out because they are smaller.
    places : list[Place]
        The largest area beyond the limit first, at most 10000.
    """

    limit: float
    grow_limit: float
    min_place_area: float
    number: int
    cells: int
    area: float
    area_beyond_limit: float
    share_of_sheet: float
    worst: float | None
    smaller: int
    places: list[Place]


@dataclasses.dataclass(frozen=True, repr=False, eq=False)
class Mesh:
    """A medial surface, or the surface of an object.

    Attributes
    ----------
    points : NDArray[float64]
        (n, 3): z, y, x in the units of the spacing; the first voxel of the array is at 0.
    faces : NDArray[int64]
        (m, 4), or (m, 3) where all are triangles: indices of points. A triangle among quadrilaterals has its last corner twice.
    thickness : NDArray[float32]
        (n,): thickness of the wall at each point; NaN where none is known.
    lower : float or None
        The lower threshold, also that of Otsu.
    """

    points: NDArray[np.float64]
    faces: NDArray[np.int64]
    thickness: NDArray[np.float32]
    lower: float | None = None

    @property
    def triangles(self) -> NDArray[np.int64]:
        """int64 (k, 3): the faces, split along the shorter diagonal, that from the first corner when both are as
        long."""
        if self.faces.shape[1] == 3:
            return self.faces
        halves = self._halves()
        return halves[halves[:, 0] != halves[:, 1]]

    def _halves(self) -> NDArray[np.int64]:
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
    def _are_triangles(self) -> NDArray[np.bool_]:
        return self.faces[:, -1] == self.faces[:, -2]

    @property
    def points_xyz(self) -> NDArray[np.float64]:
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
