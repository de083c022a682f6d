# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Functions for arrays whose work the program does, by files in a temporary folder."""

from __future__ import annotations

import contextlib
import csv
import os
import pathlib
import tempfile
from collections.abc import Iterator
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import Length, Number, check_spacing, prepare
from ._options import make_options
from ._parameters import describe
from ._program import run_on_files
from ._progress import Progress
from ._results import Mesh, Place, Places

_META_TYPES = {
    "uint8": "UCHAR", "int8": "CHAR", "uint16": "USHORT", "int16": "SHORT", "uint32": "UINT", "int32": "INT", "uint64": "ULONG_LONG",
    "int64": "LONG_LONG", "float32": "FLOAT", "float64": "DOUBLE",
}  # fmt: skip


@contextlib.contextmanager
def _as_file(array: ArrayLike, spacing: Any) -> Iterator[tuple[pathlib.Path, int]]:
    """A MetaImage of the array in a folder of its own, and the number of axes."""
    values = prepare(array)
    steps = " ".join(map(repr, check_spacing(spacing, values.ndim)[::-1]))
    with tempfile.TemporaryDirectory(prefix="medialvoxel-") as folder:
        path = pathlib.Path(folder, "array.mha")
        with path.open("wb") as file:
            file.write(
                f"ObjectType = Image\nNDims = {values.ndim}\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
                f"ElementSpacing = {steps}\nDimSize = {' '.join(map(str, values.shape[::-1]))}\n"
                f"ElementType = MET_{_META_TYPES[values.dtype.name]}\nElementDataFile = LOCAL\n".encode()
            )
            values.astype(values.dtype.newbyteorder("<"), copy=False).tofile(file)
        yield path, values.ndim


def _run(command: str, files: tuple[pathlib.Path, ...], options: dict[str, Any], progress: Progress) -> dict[str, Any]:
    """The report; messages name the array instead of its file."""
    make_options({name: value for name, value in options.items() if not isinstance(value, bool)})  # refuses empty values
    try:
        return run_on_files(command, files, options, progress)
    except (ValueError, MemoryError) as error:
        raise type(error)(str(error).replace(os.fspath(files[0]), "array")) from None


@describe
def thin_places(
    array: ArrayLike,
    *,
    thin_below: Length | tuple[Length, Length] | tuple[Length, Length | None, Length],
    thickness: Length = "auto",
    spacing: ArrayLike | None = None,
    lower: Number | Literal["otsu"] | None = None,
    upper: Number | None = None,
    label: int | None = None,
    progress: Progress = None,
    **options: Any,
) -> Places:
    """The places of an object whose walls are thinner than a limit, as `medialvoxel extract --thin-below` finds them.

    The program does it on a copy of the array in the folder for temporary files.

    Returns
    -------
    Places
    """
    with _as_file(array, spacing) as (path, dimension):
        table = path.with_name("places.csv")
        given = {"thin_below": thin_below, "thickness": thickness}
        given |= {"lower": lower, "upper": upper, "label": label, "places": table, **options}
        thin = _run("extract", (path,), given, progress)["places"]["thin"]
        with table.open(newline="", encoding="utf-8") as file:
            places = [_read_place(row, "zyx"[-dimension:]) for row in csv.DictReader(file)]
    return Places(**{name: value for name, value in thin.items() if name != "places"}, places=places)


def _read_place(row: dict[str, str], axes: str) -> Place:
    def point(prefix: str) -> tuple[float, ...]:
        return tuple(float(row[prefix + axis]) for axis in axes)

    def index(prefix: str) -> tuple[int, ...]:
        return tuple(int(row[prefix + axis]) for axis in axes)

    numbers = {name: float(row[name]) for name in ("area", "area_beyond_limit", "minimum", "mean", "maximum")}
    sides = (point("side_a_"), point("side_b_"))
    indices = {name: index(f"{name}_") for name in ("index", "first", "last")}
    uncertainty = float(row["uncertainty"]) if row["uncertainty"] else None
    return Place(
        cells=int(row["cells"]),
        center=point(""),
        sides=sides,
        uncertainty=uncertainty,
        at_edge=row["at_edge"] == "1",
        **numbers,
        **indices,
    )


@describe
def surface_thickness(
    array: ArrayLike,
    *,
    method: Literal["wall", "sphere"] = "wall",
    spacing: ArrayLike | None = None,
    lower: Number | Literal["otsu"] | None = None,
    upper: Number | None = None,
    label: int | None = None,
    progress: Progress = None,
    **options: Any,
) -> Mesh:
    """The surface of an object of 3 axes as triangles, with the local thickness of the object at its points, NaN where no wall is.

    The program does it, as `medialvoxel surface`, on a copy of the array in the folder for temporary files.

    Returns
    -------
    Mesh
    """
    with _as_file(array, spacing) as (path, dimension):
        if dimension != 3:
            raise ValueError(f"the array has {dimension} axes; a surface needs 3")
        given = {"local_thickness_method": method, "lower": lower, "upper": upper, "label": label, **options}
        surface = path.with_name("surface.ply")
        report = _run("surface", (path, surface), given, progress)
        return Mesh(*_read_ply(surface), lower=report["parameters"]["lower"])


def _read_ply(path: pathlib.Path) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.float32]]:
    """Points, triangles and thickness of a file of the program."""
    with path.open("rb") as file:
        header = [file.readline().split()]
        while header[-1] != [b"end_header"]:
            header.append(file.readline().split())
        points, faces = (int(line[2]) for line in header if line[0] == b"element")
        real = "<f8" if [b"property", b"double", b"x"] in header else "<f4"
        vertices = np.fromfile(file, [("point", real, 3), ("thickness", "<f4")], points)
        triangles = np.fromfile(file, [("corners", "u1"), ("vertices", "<i4", 3)], faces)
    return (
        vertices["point"][:, ::-1].astype(np.float64),
        triangles["vertices"].astype(np.int64),
        vertices["thickness"].astype(np.float32),
    )
