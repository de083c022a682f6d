# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Surfaces of parts in PLY files of the program, read by the definition of the format, and what is true of them."""

import array
import collections
import math


class Part:
    """Points, numbers of points by name, and triangles."""

    def __init__(self, path):
        header, _, body = path.read_bytes().partition(b"end_header\n")
        lines = header.decode("ascii").splitlines()
        vertices, faces = (int(line.split()[2]) for line in lines if line.startswith("element "))
        names = [line.split()[2] for line in lines if line.startswith("property float ")]
        words = vertices * len(names)
        numbers = array.array("f", body[: 4 * words]).tolist()
        columns = {name: numbers[place :: len(names)] for place, name in enumerate(names)}
        self.points = list(zip(*(columns.pop(name) for name in "xyz")))
        self.data = columns
        assert len(body) == 4 * words + 13 * faces
        body = body[4 * words :]
        self.triangles = [tuple(array.array("i", body[at + 1 : at + 13])) for at in range(0, len(body), 13)]

    def corners(self, triangle):
        return [self.points[vertex] for vertex in triangle]

    def areas(self):
        return [math.dist((0, 0, 0), normal(*self.corners(triangle))) / 2 for triangle in self.triangles]

    def volume(self):
        corners = map(self.corners, self.triangles)
        return sum(dot(a, cross(b, c)) for a, b, c in corners) / 6

    def open_sides(self):
        """Sides of triangles that no other triangle goes along in the opposite direction, or that two go along."""
        sides = collections.Counter((a[i], a[(i + 1) % 3]) for a in self.triangles for i in range(3))
        return sum(count != 1 or sides[side[::-1]] != 1 for side, count in sides.items())


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normal(a, b, c):
    """Of a triangle; its length is twice the area."""
    return cross([q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)])
