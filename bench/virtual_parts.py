# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Parts with walls of known thickness, with the exact share of each voxel that is material. Lengths are voxels.

A part is a list of disjoint pieces, and a piece is what several bands have in common. A band is the space between two
parallel faces: it gives each point a distance along a unit normal. Half spaces cut from a cube have a closed volume,
so the share of a voxel is exact for flat faces. Voxels are divided for edges and curved faces.

Points are arrays (n, 3) of x, y, z in indices of voxels: the first voxel has its center at 0.
"""

import itertools

import numpy as np

# Nothing is asked of the program nearer to rims, steps and faces of the volume than half a wall and this.
MARGIN = 4.0
PAD = 10
STEP = 0.9
TILTS = {
    "(0,0,1)": (0, 0, 1),
    "15 degrees": (0, 0.2588190451025207, 0.9659258262890683),
    "(1,1,0)": (1, 1, 0),
    "(1,1,1)": (1, 1, 1),
    "(1,2,5)": (1, 2, 5),
}


def unit(vector):
    return np.array(vector, float) / np.linalg.norm(vector)


def frame(normal, along=(1, 0, 0)):
    """Axes of a part, one per row: as near as possible to `along`, the rest, and the normal."""
    normal = unit(normal)
    along = np.array(along, float)
    if abs(normal @ unit(along)) > 0.99:
        along = along[[2, 0, 1]]
    first = unit(along - (along @ normal) * normal)
    return np.array([first, np.cross(normal, first), normal])


def cut_cubes(distance, normals, side):
    """Share of cubes that lies behind a plane; distance: from the center of the cube to the plane, along the normal."""
    edges = np.maximum(np.abs(normals), 1e-4) * side
    edges = np.broadcast_to(edges, (len(distance), 3))
    half = edges.sum(axis=1) / 2
    share = (distance > 0).astype(float)
    near = np.abs(distance) < half
    edges, start = edges[near], (distance + half)[near]
    total = np.zeros(len(start))
    for corner in itertools.product((0, 1), repeat=3):
        total += (-1) ** sum(corner) * np.maximum(start - edges @ np.array(corner), 0) ** 3
    share[near] = np.clip(total / (6 * edges.prod(axis=1)), 0, 1)
    return share


class FlatBand:
    """Between two planes."""

    def __init__(self, origin, normal, low, high):
        self.origin, self.normal, self.low, self.high = np.array(origin, float), unit(normal), low, high

    def distance(self, points):
        return (points - self.origin) @ self.normal, self.normal


class RoundBand:
    """Between two cylinders with the axis `direction`, or two spheres without one."""

    def __init__(self, origin, direction, low, high):
        self.origin, self.low, self.high = np.array(origin, float), low, high
        self.direction = None if direction is None else unit(direction)

    def distance(self, points):
        away = points - self.origin
        if self.direction is not None:
            away = away - (away @ self.direction)[:, None] * self.direction
        radius = np.linalg.norm(away, axis=1)
        return radius, away / np.maximum(radius, 1e-9)[:, None]


class Wall:
    """One wall of a part: its thickness, its middle and where it is measured.

    band: its two faces; limits: bands whose faces are rims, steps or junctions; gap: to the next wall.
    """

    def __init__(self, thickness, band, limits=(), gap=np.inf):
        self.thickness, self.band, self.limits = thickness, band, limits
        # A medial cell this far from the middle still covers it.
        self.reach = thickness / 2 + min(1, gap / 2)
        self.middle = (band.low + band.high) / 2

    def offset(self, points):
        """Signed distance from the middle."""
        return self.band.distance(points)[0] - self.middle

    def is_clear(self, points, size):
        """Away from all that is not this wall, and from the faces of the volume."""
        margin = self.thickness / 2 + MARGIN
        return ((points >= margin) & (points <= np.array(size) - 1 - margin)).all(axis=1) & self.is_inner(points)

    def is_inner(self, points):
        """Away from all that is not this wall."""
        margin = self.thickness / 2 + MARGIN
        inner = np.ones(len(points), bool)
        for limit in self.limits:
            distance = limit.distance(points)[0]
            inner &= (distance >= limit.low + margin) & (distance <= limit.high - margin)
        return inner

    def sample(self, size):
        """Points of the middle about a voxel apart, and the normals there."""
        axes = [np.arange(0, n, STEP) for n in size]
        points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
        points = points[np.abs(self.offset(points)) < STEP / 2]
        for _ in range(2):
            distance, normals = self.band.distance(points)
            points = points - (distance - self.middle)[:, None] * normals
        points = points[self.is_clear(points, size)]
        return points, np.broadcast_to(self.band.distance(points)[1], points.shape)


class Part:
    """Pieces (lists of bands) and walls in a volume of `size` voxels (x, y, z)."""

    def __init__(self, size, pieces, walls):
        self.size, self.pieces, self.walls = tuple(int(n) for n in size), pieces, walls

    def fill(self, division=2):
        """Share of material of each voxel, divided along each axis: (z, y, x), `division` times the size."""
        side = 1 / division
        axes = [(np.arange(n * division) + 0.5) * side - 0.5 for n in self.size[::-1]]
        result = np.empty([len(axis) for axis in axes])
        for k, z in enumerate(axes[0]):
            y, x = np.meshgrid(axes[1], axes[2], indexing="ij")
            points = np.stack((x, y, np.full_like(x, z)), axis=-1).reshape(-1, 3)
            result[k] = sum(fill_piece(piece, points, side) for piece in self.pieces).reshape(x.shape)
        return result


def fill_piece(bands, points, side):
    share = np.zeros(len(points))
    inside = np.arange(len(points))
    value = np.ones(len(points))
    for band in bands:
        distance, normals = band.distance(points[inside])
        value = value * (cut_cubes(band.high - distance, normals, side) - cut_cubes(band.low - distance, normals, side))
        inside, value = inside[value > 0], value[value > 0]
    share[inside] = value
    return share


def step_wedge(walls, normal, shift=(0, 0, 0), width=None, useful=8.0):
    """Steps of the thicknesses `walls` in a row on one flat base, in a volume that just holds them."""
    axes = frame(normal)
    lengths = [wall + 2 * MARGIN + useful for wall in walls]
    width = width or max(walls) + 2 * MARGIN + useful
    extent = np.array([sum(lengths), width, max(walls)])
    size = np.ceil(np.abs(axes.T) @ extent).astype(int) + 2 * PAD
    center = (size - 1) / 2 + np.array(shift)
    pieces, result = [], []
    start = -extent[0] / 2
    for wall, length in zip(walls, lengths):
        along = FlatBand(center, axes[0], start, start + length)
        across = FlatBand(center, axes[1], -width / 2, width / 2)
        through = FlatBand(center, axes[2], -extent[2] / 2, -extent[2] / 2 + wall)
        pieces.append([through, along, across])
        result.append(Wall(wall, through, (along, across)))
        start += length
    return Part(size, pieces, result)


def cylinders(walls, direction, shift=(0, 0, 0), size=72, inner=8.0, gap=6.0):
    """Parts of concentric tubes that cross the volume; the thinnest is the innermost one."""
    axes = frame(direction)
    radii, radius = [], inner
    for wall in walls:
        radii.append((radius, radius + wall))
        radius += wall + gap
    middle = (inner + radii[-1][1]) / 2
    origin = np.full(3, (size - 1) / 2) + np.array(shift) - middle * unit(0.8 * axes[0] + 0.6 * axes[1])
    bands = [RoundBand(origin, direction, low, high) for low, high in radii]
    return Part((size, size, size), [[band] for band in bands], [Wall(t, band) for t, band in zip(walls, bands)])


def plate(thickness, normal, shift=(0, 0, 0), size=56, half=18.0):
    """A square plate in the middle of a cube."""
    return plates([(0.0, thickness)], normal, shift, size, half)


def plates(layers, normal, shift=(0, 0, 0), size=56, half=18.0, gap=np.inf):
    """Parallel square plates; layers: distance of the middle from that of the volume, and thickness; gap: smallest."""
    axes = frame(normal, (0.31, 0.87, -0.2))
    center = np.full(3, (size - 1) / 2) + np.array(shift)
    sides = [FlatBand(center, axes[k], -half, half) for k in (0, 1)]
    bands = [FlatBand(center, axes[2], place - t / 2, place + t / 2) for place, t in layers]
    walls = [Wall(t, band, sides, gap) for (_, t), band in zip(layers, bands)]
    return Part((size, size, size), [[band, *sides] for band in bands], walls)


def shell(thickness, radius, shift=(0, 0, 0), size=64):
    center = np.full(3, (size - 1) / 2) + np.array(shift)
    band = RoundBand(center, None, radius - thickness / 2, radius + thickness / 2)
    return Part((size, size, size), [[band]], [Wall(thickness, band)])
