# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Sheets of voxels: the corners of medial cells, thinned."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

Mask = NDArray[np.bool_]
Places = NDArray[np.intp]

# The voxels around a voxel, which is not one of them, and which of them are neighbors: by a corner, and by a face.
_AROUND = np.array([step for step in itertools.product((-1, 0, 1), repeat=3) if any(step)])
_APART = np.abs(_AROUND[:, None] - _AROUND[None])
_BY_CORNER = (_APART.max(axis=-1) <= 1).astype(np.float32)
_BY_FACE = (_APART.sum(axis=-1) <= 1).astype(np.float32)
_BESIDE = np.abs(_AROUND).sum(axis=-1)  # 1: shares a face with the voxel, 2: an edge, 3: a corner


def _are_joined(members: Mask, wanted: Mask, neighbors: NDArray[np.float32]) -> Mask:
    """For each row, whether the wanted members, of which there is one at least, are connected within the members."""
    first = np.zeros_like(members)
    first[np.arange(len(members)), wanted.argmax(axis=1)] = True
    reached, more = first & wanted, np.ones(1, bool)
    while more.any():
        grown = (reached @ neighbors > 0) & members
        more, reached = grown != reached, grown
    joined: Mask = wanted.any(axis=1) & ~(wanted & ~reached).any(axis=1)
    return joined


def _are_simple(around: Mask) -> Mask:
    """Whether a voxel with these 26 voxels around it can go and leave parts, tunnels and cavities as they are
    (Bertrand and Malandain 1994): the sheet around it is in one piece, and so is the rest, as seen through its faces."""
    _, first, same = np.unique(around @ 2 ** np.arange(len(_AROUND)), return_index=True, return_inverse=True)
    around = around[first]
    rest = ~around & (_BESIDE <= 2)
    simple = _are_joined(around, around, _BY_CORNER) & _are_joined(rest, rest & (_BESIDE == 1), _BY_FACE)
    every: Mask = simple[same]
    return every


def _remove(sheet: Mask, places: Places, ways: Mask, steps: Places, around: Places) -> int:
    """Removes the places that can go to one of their ways, and returns their number."""
    places = places[sheet[places] & (ways & sheet[places[:, None] + steps]).any(axis=1)]
    places = places[_are_simple(sheet[places[:, None] + around])]
    sheet[places] = False
    return len(places)


def thin(cells: Mask, mask: Mask, depth: NDArray[np.float32]) -> Mask:
    """The corners of cells that are in the mask, thinned.

    A voxel goes where the next one in some direction is a corner of all its cells, too, and not less deep, so that each cell
    keeps a corner and the sheet its extent; and where the topology stays.

    cells, mask, depth -- of 3 axes and one shape; a cell stands at its lowest corner"""
    # With a border of background, each voxel has 26 voxels around it and is a corner of the 8 cells from (-1, -1, -1) on.
    cells, depth = np.pad(cells, [(1, 1)] * 3), np.pad(depth, 1).reshape(-1)
    sheet = np.pad(mask, 1)
    flat = sheet.reshape(-1)
    strides = np.array([sheet.shape[1] * sheet.shape[2], sheet.shape[2], 1])
    corners = np.array(list(itertools.product((0, 1), repeat=3)))
    places = np.flatnonzero(flat)
    owners = cells.reshape(-1)[places[:, None] - corners @ strides]
    flat[places] = owners.any(axis=1)
    places, owners = places[flat[places]], owners[flat[places]]
    # A step up is good where no cell lies below.
    steps = np.stack([-strides, strides], axis=1).reshape(-1)
    apart = np.stack([corners == 0, corners == 1], axis=-1).reshape(len(corners), -1)
    ways = (owners.astype(np.uint8) @ apart.astype(np.uint8) == 0) & (depth[places[:, None] + steps] >= depth[places][:, None])
    # Neighbors in a direction have different parities, so that one stays; neighbors by a corner, too.
    parity = np.array([4, 2, 1]) @ (np.stack(np.unravel_index(places, sheet.shape)) % 2)
    parts = [(places[chosen], ways[chosen]) for chosen in (ways.any(axis=1) & (parity == part) for part in range(8))]
    while sum(_remove(flat, *part, steps, _AROUND @ strides) for part in parts):
        pass
    return sheet[1:-1, 1:-1, 1:-1]
