# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The walls of an object, and where they meet."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclasses.dataclass(frozen=True)
class Wall:
    """A part of a sheet that ends where three or more walls meet, or at a sharp bend.

    Attributes
    ----------
    number : int
        Of the wall, in `Walls.numbers`: 1 is the largest one.
    cells : int
        Number of cells.
    area : float
        In squared units of the spacing.
    measured : int
        Cells whose thickness is known.
    mean, minimum, maximum, standard_deviation : float
        Of their thickness; NaN where none is known.
    centroid : tuple[float, ...]
        (z, y, x), by area; the first voxel of the array is at 0.
    normal : tuple[float, ...]
        (z, y, x), of the plane that fits the wall; its last component that is not 0 is positive.
    flatness : float
        Root mean square distance from that plane.
    rim_length : float
        Length of its free edges.
    neighbors : tuple[int, ...]
        Numbers of the walls that it meets.
    """

    number: int
    cells: int
    area: float
    measured: int
    mean: float
    minimum: float
    maximum: float
    standard_deviation: float
    centroid: tuple[float, ...]
    normal: tuple[float, ...]
    flatness: float
    rim_length: float
    neighbors: tuple[int, ...]


@dataclasses.dataclass(frozen=True)
class Seam:
    """Where the same walls meet along a line.

    Attributes
    ----------
    walls : tuple[int, ...]
        Their numbers.
    length : float
        In units of the spacing.
    angles : tuple[float, ...]
        Degrees between each two of them in the order 1-2, 1-3, ..., 2-3, ...; at 180 a wall goes straight on; NaN for walls that
        do not touch.
    """

    walls: tuple[int, ...]
    length: float
    angles: tuple[float, ...]


@dataclasses.dataclass(frozen=True, repr=False, eq=False)
class Walls:
    """The walls of an object, and the seams where they meet.

    Attributes
    ----------
    numbers : NDArray[uint32]
        The number of the wall of each medial cell, at the index of `Medial.labels`; 0: no cell, or no wall.
    walls : list[Wall]
        The largest first: wall n is ``walls[n - 1]``.
    seams : list[Seam]
        By their walls.
    lower : float or None
        The lower threshold, also that of Otsu.
    """

    numbers: NDArray[np.uint32]
    walls: list[Wall]
    seams: list[Seam]
    lower: float | None

    def __repr__(self) -> str:
        return f"Walls(numbers={self.numbers.dtype}{list(self.numbers.shape)}, {len(self.walls)} walls, {len(self.seams)} seams)"


def _read(value: float | None) -> float:
    return float("nan") if value is None else value


def read_wall(row: dict[str, Any]) -> Wall:
    """A row of the report of the program, whose axes are x, y, z."""
    thickness = row["thickness"]
    return Wall(
        number=row["wall"],
        measured=thickness["cells"],
        centroid=tuple(row["centroid"][::-1]),
        normal=tuple(row["normal"][::-1]),
        neighbors=tuple(row["neighbors"]),
        **{name: _read(thickness[name]) for name in ("mean", "minimum", "maximum", "standard_deviation")},
        **{name: row[name] for name in ("cells", "area", "flatness", "rim_length")},
    )


def read_seam(row: dict[str, Any]) -> Seam:
    return Seam(walls=tuple(row["walls"]), length=row["length"], angles=tuple(map(_read, row["angles"])))
