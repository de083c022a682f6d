# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Parts with walls whose mid-surface and thickness are known, as volumes with and without noise. Lengths are voxels.

The parts are those of test/MedialVoxelTestWalls.h. Points are arrays (n, 3) of x, y, z around the center of the part.
"""

import numpy as np
from scipy import ndimage

# The axes of a part that is turned about all axes of the volume, one per row.
TURN = np.array(
    [
        [0.8660254037844386, 0.4330127018922193, 0.25],
        [-0.5, 0.75, 0.4330127018922193],
        [0.0, -0.5, 0.8660254037844386],
    ]
)
# Where a sheet may end, and where walls meet, nothing is asked of it: half a wall and this.
MARGIN = 2.5
STEP = 0.7


def box_distance(points, center, half):
    """To a box; negative inside."""
    beyond = np.abs(points - center) - half
    return np.where(
        (beyond > 0).any(axis=1), np.linalg.norm(np.maximum(beyond, 0), axis=1), beyond.max(axis=1)
    )


class Plates:
    """Boxes together; the shortest side of each is its thickness."""

    def __init__(self, size, boxes, turn=TURN):
        self.size = size
        self.turn = turn
        self.boxes = [(np.array(center, float), np.array(half, float)) for center, half in boxes]

    def surface(self, points):
        return np.min([box_distance(points @ self.turn.T, *box) for box in self.boxes], axis=0)

    def _middles(self, points):
        """Distance to the mid-plane of each box."""
        flat = [np.where(np.arange(3) == half.argmin(), 0, half) for _, half in self.boxes]
        own = points @ self.turn.T
        return np.array([np.maximum(box_distance(own, box[0], half), 0) for box, half in zip(self.boxes, flat)])

    def middle(self, points):
        return self._middles(points).min(axis=0)

    def thickness(self, points):
        """Of the nearest wall; not a number near its rims and near other walls."""
        own, nearest = points @ self.turn.T, self._middles(points).argmin(axis=0)
        result = np.full(len(points), np.nan)
        for k, (center, half) in enumerate(self.boxes):
            clear = np.where(np.arange(3) == half.argmin(), np.inf, half - half.min() - MARGIN)
            inner = (nearest == k) & (np.abs(own - center) <= clear).all(axis=1)
            for other, box in enumerate(self.boxes):
                if other != k:
                    inner &= box_distance(own, *box) > half.min() + MARGIN
            result[inner] = 2 * half.min()
        return result

    def samples(self):
        """Points of the mid-planes that a sheet must cover."""
        result = []
        for center, half in self.boxes:
            axis = half.argmin()
            reach = half - half[axis] - MARGIN
            lines = [np.arange(-r, r + 1e-9, STEP) if i != axis else np.zeros(1) for i, r in enumerate(reach)]
            result.append(center + np.stack(np.meshgrid(*lines), axis=-1).reshape(-1, 3))
        return np.concatenate(result) @ self.turn


class Shell:
    """A closed sphere."""

    def __init__(self, size, radius, wall):
        self.size = size
        self.radius = radius
        self.wall = wall

    def surface(self, points):
        return self.middle(points) - self.wall / 2

    def middle(self, points):
        return np.abs(np.linalg.norm(points, axis=1) - self.radius)

    def thickness(self, points):
        return np.full(len(points), float(self.wall))

    def samples(self):
        number = np.arange(4000)
        z, angle = 1 - (2 * number + 1) / len(number), 2.399963229728653 * number
        ring = np.sqrt(1 - z * z)
        return self.radius * np.stack((ring * np.cos(angle), ring * np.sin(angle), z), axis=1)


def square_plate(wall, turn):
    return Plates(72, [((0, 0, 0), (24, 24, wall / 2))], turn)


def tee():
    return Plates(72, [((0, 0, -12), (24, 20, 2)), ((0, 0, 4), (2, 20, 16))])


def ribs():
    boxes = [((0, 0, -16), (46, 20, 2)), ((44, 0, 0), (2, 20, 18))]
    boxes += [((-36 + 21 * k, 0, 0), (wall / 2, 20, 16)) for k, wall in enumerate((2, 3, 5, 8))]
    return Plates(112, boxes)


def points_of(part):
    """Centers of all voxels, in the order of the volume (z, y, x)."""
    axis = np.arange(part.size) - (part.size - 1) / 2
    z, y, x = np.meshgrid(axis, axis, axis, indexing="ij")
    return np.stack((x, y, z), axis=-1).reshape(-1, 3)


def clean(part):
    """The object, uint8 (z, y, x)."""
    inside = part.surface(points_of(part)) < 0
    return inside.reshape(part.size, part.size, part.size).astype(np.uint8)


def flips(mask):
    """A tenth of the voxels next to the surface changes sides."""
    cross = ndimage.generate_binary_structure(3, 1)
    beside = ndimage.binary_dilation(mask, cross) & ~ndimage.binary_erosion(mask, cross, border_value=1)
    return mask ^ (beside & (np.random.default_rng(77).random(mask.shape) < 0.1))


def scan(mask):
    """Blurred, with noise of 18 % of the contrast."""
    values = ndimage.gaussian_filter(mask.astype(float), 0.76)
    values += 0.18 * np.random.default_rng(77).standard_normal(mask.shape)
    return (values > 0.5).astype(np.uint8)


# Title: the part, and its noise.
PARTS = {
    "plate of 4": (square_plate(4, np.eye(3)), None),
    "plate of 2, turned": (square_plate(2, TURN), None),
    "plate of 4, turned": (square_plate(4, TURN), None),
    "T of 4": (tee(), None),
    "shell of 4": (Shell(72, 24, 4), None),
    "ribs of 2 to 8": (ribs(), None),
    "ribs, flips": (ribs(), flips),
    "ribs, scan": (ribs(), scan),
}
