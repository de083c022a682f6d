# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The walls of a medial surface: its parts between junctions, with their areas and thicknesses."""

import dataclasses

import numpy as np
from vtk.util.numpy_support import vtk_to_numpy


@dataclasses.dataclass(frozen=True)
class Wall:
    """A part of the surface that ends at rims and junctions. Lengths have the units of the points (mm)."""

    area: float
    minimum: float
    mean: float
    maximum: float
    thinnest: tuple  # where the wall is thinnest, in the coordinates of the surface


def walls_of(surface, smallest=0.0, most=200):
    """The walls of a surface (vtkPolyData) that the module made, largest first.

    smallest -- walls of a smaller area are left out
    most     -- no more walls than this
    Raises ValueError when the surface has not the arrays Thickness, Area and JunctionEdges.
    """
    thickness = _array(surface.GetPointData(), "Thickness")
    areas = _array(surface.GetCellData(), "Area").astype(float)
    junctions = _array(surface.GetCellData(), "JunctionEdges")
    if not len(areas):
        return []
    corners, cells, places = _corners(surface)
    wall = _connected(len(areas), *_joints(corners, cells, places, junctions))
    numbers, wall = np.unique(wall, return_inverse=True)
    area = np.bincount(wall, areas)
    minimum, mean, maximum, thinnest = _measures(thickness[corners], cells, wall, areas, len(numbers))
    points = vtk_to_numpy(surface.GetPoints().GetData())[corners[thinnest]]
    order = [k for k in np.argsort(-area, kind="stable") if area[k] >= smallest][:most]
    return [
        Wall(float(area[k]), float(minimum[k]), float(mean[k]), float(maximum[k]), tuple(map(float, points[k])))
        for k in order
    ]


def _array(data, name):
    array = data.GetArray(name)
    if array is None:
        raise ValueError(f"The surface has no array {name}: it was not made by Medial Voxel Extraction.")
    return vtk_to_numpy(array)


def _corners(surface):
    """Points at the corners of all faces, the faces they belong to, and their places in these."""
    polygons = surface.GetPolys()
    corners = vtk_to_numpy(polygons.GetConnectivityArray()).astype(np.int64)
    offsets = vtk_to_numpy(polygons.GetOffsetsArray()).astype(np.int64)
    cells = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    return corners, cells, np.arange(len(corners)) - offsets[cells]


def _joints(corners, cells, places, junctions):
    """Pairs of faces that share a side which is no junction."""
    count = np.bincount(cells)[cells]
    following = corners[np.arange(len(corners)) - places + (places + 1) % count]
    sides = np.sort(np.stack((corners, following), axis=1), axis=1)
    inside = (junctions[cells].astype(np.int64) >> places) & 1 == 0
    sides, faces = sides[inside], cells[inside]
    order = np.lexsort((sides[:, 1], sides[:, 0]))
    sides, faces = sides[order], faces[order]
    same = (sides[1:] == sides[:-1]).all(axis=1)
    return faces[:-1][same], faces[1:][same]


def _connected(count, first, second):
    """The smallest face that each face is connected with."""
    smallest = np.arange(count)
    while True:
        before = smallest.copy()
        lower = np.minimum(smallest[first], smallest[second])
        np.minimum.at(smallest, before[first], lower)
        np.minimum.at(smallest, before[second], lower)
        smallest = smallest[smallest]
        if np.array_equal(smallest, before):
            return smallest


def _measures(thickness, cells, wall, areas, count):
    """Minimum, mean over the area and maximum of each wall, and the corner where it is thinnest."""
    order = np.lexsort((thickness, wall[cells]))
    walls = wall[cells][order]
    first = np.searchsorted(walls, np.arange(count))
    last = np.searchsorted(walls, np.arange(count), side="right") - 1
    of_face = np.bincount(cells, thickness) / np.bincount(cells)
    weight = np.maximum(areas, np.finfo(float).tiny)
    mean = np.bincount(wall, of_face * weight) / np.bincount(wall, weight)
    return thickness[order[first]], mean, thickness[order[last]], order[first]
