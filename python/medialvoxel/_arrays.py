# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The functions for arrays."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, Literal, Union

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from . import _native
from ._options import make_flags, make_options, read_flag
from ._parameters import describe
from ._progress import Progress, show
from ._results import Distances, LocalThickness, Medial, Mesh
from ._threads import count_processors
from ._walls import Walls, read_seam, read_wall
from ._warnings import warn

Number = Union[int, float, np.integer[Any], np.floating[Any]]
Length = Union[Number, str]
Smooth = Union[Literal["auto", "on", "off"], bool, None]


def prepare(array: ArrayLike) -> NDArray[Any]:
    """The values as the library reads them; a copy only where they are not so already."""
    if isinstance(array, np.ma.MaskedArray):
        raise ValueError("the array is masked; fill it first, such as by array.filled(0)")
    values = np.asarray(array)
    if values.ndim not in (2, 3):
        raise ValueError(f"the array has {values.ndim} axes; it must have 2 or 3")
    if values.size == 0:
        raise ValueError(f"the array has the shape {values.shape}; each size must be 1 or more")
    kind, size = values.dtype.kind, values.dtype.itemsize
    if kind == "b":
        return np.ascontiguousarray(values).view(np.uint8)
    if kind == "f" and size == 2:
        return np.ascontiguousarray(values, np.float32)
    if kind in "iuf" and size <= 8:
        return np.ascontiguousarray(values, values.dtype.newbyteorder("="))
    raise ValueError(
        f"the values are {values.dtype}; they must be bool, integers of 8 to 64 bits, or real numbers of 16, 32 or 64 bits"
    )


def check_spacing(spacing: Any, dimension: int) -> tuple[float, ...]:
    if spacing is None:
        return (1.0,) * dimension
    try:
        numbers = tuple(float(part) for part in np.broadcast_to(spacing, (dimension,)))
    except (TypeError, ValueError):
        axes = "(z, y, x)" if dimension == 3 else "(y, x)"
        raise ValueError(f"the spacing is {spacing!r}; it must be a number or one for each axis, {axes}") from None
    return numbers


class _Call:
    """An array, and what is made of it."""

    def __init__(self, array: ArrayLike, spacing: Any) -> None:
        self.values = prepare(array)
        self.shape = self.values.shape
        self.spacing = check_spacing(spacing, self.values.ndim)

    def make(self, dtype: DTypeLike, components: int = 1) -> NDArray[Any]:
        """An output for run(), which writes each of its values."""
        return np.empty(self.shape + ((components,) if components > 1 else ()), dtype)

    def make_vectors(self, wanted: bool) -> NDArray[np.float32] | None:
        return self.make(np.float32, 3) if wanted else None

    def take_vectors(self, vectors: NDArray[np.float32] | None) -> NDArray[np.float32] | None:
        """Vectors with a number for each axis of the array."""
        return vectors if vectors is None or len(self.shape) == 3 else np.ascontiguousarray(vectors[..., 1:])

    def run(self, arguments: Sequence[str], outputs: dict[str, NDArray[Any] | None], progress: Progress) -> Any:
        with show(progress) as take:
            numbers, surface = _native.run(self.values, self.spacing, arguments, outputs, take)
        warn(numbers["warnings"])
        return numbers, surface


@describe
def extract(
    array: ArrayLike,
    *,
    thickness: Length = "auto",
    spacing: ArrayLike | None = None,
    lower: Number | Literal["otsu"] | None = None,
    upper: Number | None = None,
    label: int | None = None,
    labels: Literal["all"] | Iterable[int] | None = None,
    smooth: Smooth = None,
    min_thickness: Length | None = None,
    max_thickness: Length | None = None,
    max_pore_size: int | None = None,
    thickness_map: bool = True,
    uncertainty: bool = False,
    importance: bool = False,
    same_topology: bool = False,
    vectors: bool = False,
    vector_boundary: Literal["object", "background"] = "object",
    sub_voxel: bool | None = None,
    materials: tuple[Number, Number] | None = None,
    threads: int | None = None,
    memory: int | str | None = None,
    progress: Progress = None,
) -> Medial:
    """The medial cells of an object, the thickness of its walls, and vectors to its boundary.

    Returns
    -------
    Medial

    Examples
    --------
    >>> import numpy as np
    >>> ring = np.hypot(*np.mgrid[-20:21, -20:21])
    >>> walls = extract(ring, lower=8, upper=13, spacing=0.5, vectors=True)
    >>> walls.labels.shape, walls.vectors.shape, walls.origin
    ((41, 41), (41, 41, 2), (0.25, 0.25))
    """
    call = _Call(array, spacing)
    separate = labels is not None
    thickness_map, uncertainty = read_flag("thickness_map", thickness_map), read_flag("uncertainty", uncertainty)
    vectors, importance = (
        read_flag(name, value) and not separate for name, value in (("vectors", vectors), ("importance", importance))
    )
    outputs: dict[str, Any] = {
        "labels": call.make(np.uint8),
        "thickness": call.make(np.float32) if thickness_map else None,
        "uncertainty": call.make(np.float32) if uncertainty else None,
        "importance": call.make(np.float32) if importance else None,
        "vectors": call.make_vectors(vectors),
        "objects": call.make(call.values.dtype) if separate else None,
    }
    options = _make_thickness_options(thickness, smooth, min_thickness, max_thickness, max_pore_size)
    options |= {
        "lower": lower,
        "upper": upper,
        "label": label,
        "labels": labels,
        "thickness_map": "thickness.mha" if thickness_map else None,
        "uncertainty_map": "uncertainty.mha" if uncertainty else None,
        "importance": "importance.mha" if importance else None,
        "same_topology": read_flag("same_topology", same_topology) or None,
        "sub_voxel": sub_voxel,
        "materials": materials,
        "vectors": "vectors.mha" if vectors else None,
        "vector_boundary": vector_boundary if vectors else None,
        "threads": count_processors() if threads is None else threads,
        "memory": memory,
    }
    numbers, _ = call.run(["extract", "array", "labels.mha", *make_options(options)], outputs, progress)
    outputs["vectors"] = call.take_vectors(outputs["vectors"])
    return Medial(
        **_part_rims(outputs),
        counts=numbers["counts"],
        topology=numbers.get("topology"),
        object_counts=numbers.get("objects", []),
        origin=tuple(0.5 * step if size > 1 else 0.0 for size, step in zip(call.shape, call.spacing)),
        spacing=call.spacing,
        measure=numbers["measure"],
        smoothed=numbers["smoothed"],
        roughness=numbers["roughness"],
        max_thickness=numbers["max_thickness"],
        lower=numbers["lower"],
    )


@describe
def mesh(
    array: ArrayLike,
    *,
    thickness: Length = "auto",
    spacing: ArrayLike | None = None,
    lower: Number | Literal["otsu"] | None = None,
    upper: Number | None = None,
    label: int | None = None,
    smooth: Smooth = None,
    min_thickness: Length | None = None,
    max_thickness: Length | None = None,
    max_pore_size: int | None = None,
    triangles: bool = False,
    min_component_size: int | None = None,
    min_branch_length: Length | None = None,
    element_size: Length | None = None,
    extend_rims: bool = False,
    sub_voxel: bool | None = None,
    threads: int | None = None,
    memory: int | str | None = None,
    progress: Progress = None,
) -> Mesh:
    """The medial surface of an object of 3 axes as a mesh, with the thickness of the walls at its points.

    Returns
    -------
    Mesh

    Examples
    --------
    >>> import numpy as np
    >>> plate = np.zeros((12, 30, 30))
    >>> plate[4:8, 3:27, 3:27] = 1
    >>> surface = mesh(plate)
    >>> surface.faces.shape[1], float(surface.points[:, 0].mean().round(3))
    (4, 5.5)
    """
    call = _Call(array, spacing)
    if len(call.shape) != 3:
        raise ValueError(f"the array has {len(call.shape)} axes; a mesh needs 3")
    options = _make_thickness_options(thickness, smooth, min_thickness, max_thickness, max_pore_size)
    options |= {
        "lower": lower,
        "upper": upper,
        "label": label,
        "min_component_size": min_component_size,
        "min_branch_length": min_branch_length,
        "element_size": element_size,
        "sub_voxel": sub_voxel,
        "threads": count_processors() if threads is None else threads,
        "memory": memory,
    }
    flags = make_flags({"triangles": triangles, "extend_rims": extend_rims})
    numbers, surface = call.run(["mesh", "array", "mesh.vtp", *make_options(options), *flags], {}, progress)
    points, faces, thickness_of_points = surface
    return Mesh(points, faces, thickness_of_points, numbers["lower"])


@describe
def walls(
    array: ArrayLike,
    *,
    thickness: Length = "auto",
    spacing: ArrayLike | None = None,
    lower: Number | Literal["otsu"] | None = None,
    upper: Number | None = None,
    label: int | None = None,
    smooth: Smooth = None,
    min_thickness: Length | None = None,
    max_thickness: Length | None = None,
    max_pore_size: int | None = None,
    sub_voxel: bool | None = None,
    materials: tuple[Number, Number] | None = None,
    threads: int | None = None,
    memory: int | str | None = None,
    progress: Progress = None,
) -> Walls:
    """The walls of an object of 3 axes, cut where three or more of them meet and at sharp bends, and the seams there.

    The whole sheet is in memory, with up to 300 bytes for each cell.

    Returns
    -------
    Walls

    Examples
    --------
    >>> import numpy as np
    >>> tee = np.zeros((32, 36, 44), bool)
    >>> tee[4:8, 4:32, 4:40] = True
    >>> tee[8:28, 4:32, 20:24] = True
    >>> found = walls(tee)
    >>> len(found.walls), [seam.walls for seam in found.seams]
    (3, [(1, 2, 3)])
    """
    call = _Call(array, spacing)
    if len(call.shape) != 3:
        raise ValueError(f"the array has {len(call.shape)} axes; walls need 3")
    outputs: dict[str, Any] = {"walls": call.make(np.uint32)}
    options = _make_thickness_options(thickness, smooth, min_thickness, max_thickness, max_pore_size)
    options |= {
        "walls": "walls.mha",
        "lower": lower,
        "upper": upper,
        "label": label,
        "sub_voxel": sub_voxel,
        "materials": materials,
        "threads": count_processors() if threads is None else threads,
        "memory": memory,
    }
    numbers, _ = call.run(["extract", "array", *make_options(options)], outputs, progress)
    rows, seams = [read_wall(row) for row in numbers["walls"]], [read_seam(row) for row in numbers["seams"]]
    return Walls(outputs["walls"], rows, seams, numbers["lower"])


@describe
def distance(
    array: ArrayLike,
    *,
    spacing: ArrayLike | None = None,
    lower: Number | Literal["otsu"] | None = None,
    upper: Number | None = None,
    label: int | None = None,
    boundary: Literal["object", "background"] = "object",
    region: Literal["both", "inside", "outside"] = "both",
    vectors: bool = False,
    max_distance: Length | None = None,
    threads: int | None = None,
    memory: int | str | None = None,
    progress: Progress = None,
) -> Distances:
    """Exact signed distances, and vectors, to the nearest boundary voxel.

    Returns
    -------
    Distances

    Examples
    --------
    >>> import numpy as np
    >>> bar = np.zeros((7, 7), np.uint8)
    >>> bar[2:5, :] = 1
    >>> distance(bar).distance[:, 3].tolist()
    [2.0, 1.0, 0.0, -1.0, 0.0, 1.0, 2.0]
    """
    call = _Call(array, spacing)
    outputs: dict[str, Any] = {"vectors": call.make_vectors(read_flag("vectors", vectors)), "distance": call.make(np.float32)}
    options = {
        "lower": lower,
        "upper": upper,
        "label": label,
        "boundary": boundary,
        "region": region,
        "max_distance": max_distance,
        "threads": count_processors() if threads is None else threads,
        "memory": memory,
    }
    numbers, _ = call.run(["distance", "array", "vectors.mha", *make_options(options)], outputs, progress)
    outputs["vectors"] = call.take_vectors(outputs["vectors"])
    return Distances(**outputs, counts=numbers["counts"], lower=numbers["lower"])


@describe
def local_thickness(
    array: ArrayLike,
    *,
    spacing: ArrayLike | None = None,
    lower: Number | Literal["otsu"] | None = None,
    upper: Number | None = None,
    method: Literal["wall", "sphere"] = "wall",
    sub_voxel: bool | None = None,
    largest_ball: Length | None = None,
    label: int | None = None,
    threads: int | None = None,
    memory: int | str | None = None,
    progress: Progress = None,
) -> LocalThickness:
    """Of each object voxel, the thickness of the wall whose ball is the largest that covers it.

    extract() measures walls in the same way, from face to face, here with its defaults but without smoothing and pores. Nothing
    is known outside of the array: an object that it cuts may be found too thick beside its faces.

    Returns
    -------
    LocalThickness

    Examples
    --------
    >>> import numpy as np
    >>> plate = np.zeros((12, 30, 30), bool)
    >>> plate[4:8] = True
    >>> found = local_thickness(plate, spacing=0.5)
    >>> np.unique(found.thickness).tolist(), found.counts["voxels_at_maximum"]
    ([0.0, 2.0], 0)
    """
    call = _Call(array, spacing)
    outputs: dict[str, Any] = {"thickness": call.make(np.float32)}
    options = {
        "local_thickness_method": method,
        "largest_ball": largest_ball,
        "sub_voxel": sub_voxel,
        "lower": lower,
        "upper": upper,
        "label": label,
        "threads": count_processors() if threads is None else threads,
        "memory": memory,
    }
    words = ["surface", "array", "thickness.vtp", *make_options(options)]
    numbers, _ = call.run(words, outputs, progress)
    return LocalThickness(**outputs, counts=numbers["counts"], lower=numbers["lower"])


def _part_rims(outputs: dict[str, Any]) -> dict[str, Any]:
    """The sign of a thickness as a mask of its own, so that what is greater than 0 was measured."""
    thickness = outputs["thickness"]
    rims = None if thickness is None else thickness < 0
    if rims is not None:
        thickness[rims] = 0
    return outputs | {"rims": rims}


def _make_thickness_options(
    thickness: Any, smooth: Any, min_thickness: Any, max_thickness: Any, max_pore_size: Any
) -> dict[str, Any]:
    return {
        "thickness": thickness,
        "smooth": smooth,
        "min_thickness": min_thickness,
        "max_thickness": max_thickness,
        "max_pore_size": max_pore_size,
    }
