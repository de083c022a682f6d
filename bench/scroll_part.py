# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""A rolled sheet whose mid-surface is known, as a part of sheet_parts.py. Lengths are voxels."""

import numpy as np
from scipy import spatial

from sheet_parts import MARGIN, STEP, TURN

FINE = 0.1
CHUNK = 500_000


class Scroll:
    """A spiral of Archimedes, drawn along an axis: all that is nearer than half a wall to the sheet.

    pitch    -- from winding to winding
    windings -- first and last turn; the sheet begins at the radius pitch * first
    half     -- half of its height
    """

    def __init__(self, size, wall, pitch, windings, half, turn=TURN):
        self.size, self.wall, self.half, self.turn = size, wall, half, turn
        angle = 2 * np.pi * np.arange(windings[0], windings[1], FINE / (2 * np.pi * pitch * windings[1]))
        radius = pitch * angle / (2 * np.pi)
        self.curve = radius[:, None] * np.stack((np.cos(angle), np.sin(angle)), axis=1)
        steps = np.linalg.norm(np.diff(self.curve, axis=0), axis=1)
        self.along = np.concatenate(((0.0,), np.cumsum(steps)))
        self.tree = spatial.KDTree(self.curve)

    def _measure(self, points):
        """Distance to the curve in the plane across the axis, height beyond the sheet, nearest place along the curve."""
        own = points @ self.turn.T
        distance, nearest = self.tree.query(own[:, :2])
        return distance, np.maximum(np.abs(own[:, 2]) - self.half, 0), self.along[nearest], np.abs(own[:, 2])

    def middle(self, points):
        across, beyond = (self._measure(points)[k] for k in (0, 1))
        return np.hypot(across, beyond)

    def surface(self, points):
        parts = np.array_split(points, max(1, len(points) // CHUNK))
        return np.concatenate([self.middle(part) for part in parts]) - self.wall / 2

    def thickness(self, points):
        """Of the wall; not a number near its rims."""
        _, beyond, along, height = self._measure(points)
        clear = self.wall / 2 + MARGIN
        inner = (beyond == 0) & (height < self.half - clear) & (along > clear) & (along < self.along[-1] - clear)
        return np.where(inner, float(self.wall), np.nan)

    def samples(self):
        """Points of the mid-surface that a sheet must cover; at rims, nothing is asked within half a wall and a margin."""
        clear = self.wall / 2 + MARGIN
        places = np.arange(clear, self.along[-1] - clear, STEP)
        flat = np.stack([np.interp(places, self.along, self.curve[:, k]) for k in range(2)], axis=1)
        heights = np.arange(-self.half + clear, self.half - clear + 1e-9, STEP)
        own = np.concatenate((np.repeat(flat, len(heights), axis=0), np.tile(heights, len(flat))[:, None]), axis=1)
        return own @ self.turn
