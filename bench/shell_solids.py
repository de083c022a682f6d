# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Parts as solid elements of their true shape, which shell meshes are compared with, in the same solver."""

import numpy

# Nodes of the faces of a hexahedron.
FACES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))


class Solid:
    """Hexahedra between the lines of three axes, where a cell belongs to the part; the map bends the axes."""

    freedoms = 3  # of a node

    def __init__(self, lines, is_part, bend=lambda places: places):
        sizes = [len(line) for line in lines]
        middles = numpy.meshgrid(*((line[1:] + line[:-1]) / 2 for line in lines), indexing="ij")
        cells = numpy.argwhere(is_part(*middles))
        steps = numpy.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)])
        corners = numpy.ravel_multi_index(tuple(numpy.moveaxis(cells[:, None] + steps, 2, 0)), sizes)
        used, self.corners = numpy.unique(corners, return_inverse=True)
        self.corners = self.corners.reshape(-1, 8)
        self.axes = numpy.array([line[i] for line, i in zip(lines, numpy.unravel_index(used, sizes))]).T
        self.places = bend(self.axes)
        self.nodes = {number + 1: place for number, place in enumerate(self.places)}

    def mesh_text(self, modulus, poisson_ratio, density=2.7e-9):
        text = ["*NODE, NSET=ALL_NODES"]
        # ccx reads 20 characters of a number.
        text += [f"{number}, {x:.12g}, {y:.12g}, {z:.12g}" for number, (x, y, z) in enumerate(self.places.tolist(), 1)]
        text += ["*ELEMENT, TYPE=C3D8I, ELSET=ALL"]
        text += [f"{number}, " + ", ".join(map(str, nodes)) for number, nodes in enumerate((self.corners + 1).tolist(), 1)]
        text += ["*MATERIAL, NAME=METAL", "*ELASTIC", f"{modulus!r}, {poisson_ratio!r}", "*DENSITY", f"{density!r}"]
        return "\n".join([*text, "*SOLID SECTION, ELSET=ALL, MATERIAL=METAL"]) + "\n"

    def areas(self, is_there):
        """Of the faces all of whose corners are there, by node; is_there: one value for each node."""
        areas = numpy.zeros(len(self.places))
        for face in FACES:
            nodes = self.corners[:, face]
            nodes = nodes[is_there[nodes].all(axis=1)]
            a, b, c, d = (self.places[nodes[:, corner]] for corner in range(4))
            area = numpy.linalg.norm(numpy.cross(c - a, d - b), axis=1) / 2
            numpy.add.at(areas, nodes, area[:, None] / 4)
        return areas


class Sheet:
    """Quadrilaterals of one thickness: lines of a section, moved along x. As ShellModel, for the same solver."""

    freedoms = 6

    def __init__(self, length, lines, thickness, size):
        """lines: of places (y, z), at most a size apart; equal places are one node."""
        self.thickness = thickness
        ways = divide(0.0, length, size=size)
        section, pairs = {}, []
        for line in lines:
            keys = [section.setdefault(tuple(numpy.round(place, 6)), len(section)) for place in line]
            pairs += zip(keys, keys[1:])
        number = 0
        self.nodes = {}
        for way in ways:
            for y, z in section:
                number += 1
                self.nodes[number] = (way, y, z)
        steps = range(0, number - len(section), len(section))
        self.faces = [[at + a + 1, at + len(section) + a + 1, at + len(section) + b + 1, at + b + 1] for at in steps for a, b in pairs]

    def elements(self):
        return self.faces

    def mesh_text(self, modulus, poisson_ratio, density=2.7e-9):
        text = ["*NODE, NSET=ALL_NODES"]
        text += [f"{number}, {x:.12g}, {y:.12g}, {z:.12g}" for number, (x, y, z) in self.nodes.items()]
        text += ["*ELEMENT, TYPE=S4, ELSET=ALL"]
        text += [f"{number}, " + ", ".join(map(str, nodes)) for number, nodes in enumerate(self.faces, 1)]
        text += ["*MATERIAL, NAME=METAL", "*ELASTIC", f"{modulus!r}, {poisson_ratio!r}", "*DENSITY", f"{density!r}"]
        return "\n".join([*text, "*SHELL SECTION, ELSET=ALL, MATERIAL=METAL", f"{self.thickness!r}"]) + "\n"


def straight(begin, end, size):
    """Places on the way from one to another."""
    begin, end = numpy.array(begin, float), numpy.array(end, float)
    return begin + divide(0.0, 1.0, size=size / numpy.linalg.norm(end - begin))[:, None] * (end - begin)


def divide(*stops, size):
    """Lines at the stops, and between them at most a size apart."""
    stops = sorted(set(stops))
    parts = [
        numpy.linspace(a, b, max(1, int(numpy.ceil((b - a) / size - 1e-9))), endpoint=False) for a, b in zip(stops, stops[1:])
    ]
    return numpy.concatenate([*parts, stops[-1:]])
