# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Medial voxels, wall thickness and distances of NumPy arrays.

Everything has the order of NumPy's axes: spacing, vectors, points and voxels are (z, y, x), or (y, x) in two dimensions.
Results have the bytes of the program `medialvoxel`, which this package brings, and own their memory.

    >>> import numpy as np
    >>> import medialvoxel
    >>> plate = np.zeros((24, 40, 40), bool)
    >>> plate[10:14, 4:36, 4:36] = True
    >>> sheet = medialvoxel.extract(plate)
    >>> int(np.count_nonzero(sheet.medial)), float(np.median(sheet.thickness[sheet.thickness > 0]))
    (841, 4.0)
"""

from ._arrays import distance, extract, local_thickness, mesh, walls
from ._by_program import surface_thickness, thin_places
from ._native import version as _version
from ._program import NotMeasuredError, ThinPlacesError, distance_file, extract_file, info, mesh_file, surface_file
from ._results import Distances, LocalThickness, Medial, Mesh, Place, Places
from ._walls import Seam, Wall, Walls
from ._warnings import MedialVoxelWarning

__all__ = [
    "Distances", "LocalThickness", "Medial", "MedialVoxelWarning", "Mesh", "NotMeasuredError", "Place", "Places", "Seam",
    "ThinPlacesError", "Wall", "Walls", "distance", "distance_file", "extract", "extract_file", "info", "local_thickness", "mesh", "mesh_file",
    "surface_file", "surface_thickness", "thin_places", "walls",
]  # fmt: skip
__version__ = _version()
