# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Profiles, an arch and a plate that oscillates: shell meshes against solid elements of the true shape.

The compliance is the sum of forces times displacements of a load of one unit, that is the deflection in bending and the
angle in torsion. Each mesh is compared with the part, and with a part cut to the length and width of the sheet.
"""

import numpy

from shell_parts import Arch, Box, Plate, Tee
from shell_solids import Sheet, Solid, divide, straight
from shell_model import find_frequencies, solve

MATERIAL = (70000.0, 0.3)
MODES = 3
# Nodes within this part of an element from an end belong to it: rims of voxels are not straight.
END = 0.45


class Study:
    """A part under one load. Lengths of the sheet take the place of those of the part where they are given."""

    def __init__(self, part):
        self.part = part
        self.t = part.thickness

    def lengths(self):
        """Of the part that the sheet changes."""
        raise NotImplementedError

    def sheet_lengths(self, places):
        raise NotImplementedError

    def solid(self, lengths, size):
        raise NotImplementedError

    def section(self, lengths, size):
        """Lines of the middle of its walls, as places (y, z)."""
        raise NotImplementedError

    def result(self, mesh, folder):
        """What is compared, of a Mesh."""
        raise NotImplementedError


class Mesh:
    """What a shell mesh and a solid have in common: places on the axes of the part, and weights of nodes for loads."""

    def __init__(self, model, places, axes, number):
        self.model, self.places, self.axes, self.number = model, places, axes, number

    @property
    def x(self):
        return self.places[:, 0]

    def held_nodes(self, is_held):
        return [int(number) for number in self.number[is_held]]

    def compliance(self, is_held, forces, folder):
        """Forces: on the axes of the part, a row for each node."""
        loaded = numpy.flatnonzero(numpy.abs(forces).sum(axis=1) > 0)
        rows = dict(zip(self.number[loaded].tolist(), map(tuple, (forces[loaded] @ self.axes).tolist())))
        moved = solve(self.model, MATERIAL, self.held_nodes(is_held), rows, folder)
        return sum(numpy.dot(force, moved[number]) for number, force in rows.items())


class ShellMesh(Mesh):
    def __init__(self, model, places, axes, size):
        """size: of the elements."""
        self.size = size
        number = numpy.array(list(model.nodes))
        super().__init__(model, places, axes, number)
        index = {int(n): i for i, n in enumerate(number)}
        self.faces = [[index[n] for n in nodes] for nodes in model.elements()]

    def is_first(self):
        return self.x < self.x.min() + END * self.size

    def is_last(self):
        return self.x > self.x.max() - END * self.size

    def end_weights(self):
        """Half of the sides at the end, by node."""
        weights, is_end = numpy.zeros(len(self.places)), self.is_last()
        for face in self.faces:
            for a, b in zip(face, face[1:] + face[:1]):
                if is_end[a] and is_end[b]:
                    weights[[a, b]] += numpy.linalg.norm(self.places[a] - self.places[b]) / 2
        return weights

    def pressed_areas(self):
        """Of the sheet, by node."""
        areas = numpy.zeros(len(self.places))
        for face in self.faces:
            a, b, *others = self.places[face]
            area = sum(
                numpy.linalg.norm(numpy.cross(p - a, q - a)) / 2 for p, q in zip([b, *others], others)
            )
            areas[face] += area / len(face)
        return areas


class SolidMesh(Mesh):
    def __init__(self, solid, thickness):
        super().__init__(solid, solid.places, numpy.eye(3), numpy.arange(1, len(solid.places) + 1))
        self.thickness = thickness

    def is_first(self):
        return self.x < self.x.min() + 1e-6

    def is_last(self):
        return self.x > self.x.max() - 1e-6

    def end_weights(self):
        return self.model.areas(self.is_last())

    def pressed_areas(self):
        """Half of both sides of an arch: as large as its middle."""
        radius = self.model.axes[:, 1]
        return sum(self.model.areas(numpy.isclose(radius, side)) / 2 for side in (radius.min(), radius.max()))


class Cantilever(Study):
    """Held at one end, bent or turned at the other."""

    def __init__(self, part, is_torsion):
        super().__init__(part)
        self.is_torsion = is_torsion

    def result(self, mesh, folder):
        weights = mesh.end_weights()
        if self.is_torsion:
            from_middle = mesh.places - weights @ mesh.places / weights.sum()
            forces = weights[:, None] * numpy.cross([1.0, 0, 0], from_middle)
            forces /= (weights * (from_middle[:, 1:] ** 2).sum(axis=1)).sum()
        else:
            forces = weights[:, None] * numpy.array([0, 0, 1.0]) / weights.sum()
        return [mesh.compliance(mesh.is_first(), forces, folder)]

    @staticmethod
    def length_of(mesh):
        return mesh.x[mesh.is_last()].mean() - mesh.x[mesh.is_first()].mean()


class TeeStudy(Cantilever):
    def lengths(self):
        return {"length": self.part.LENGTH, "width": self.part.WIDTH, "bottom": -self.part.HEIGHT / 2}

    def sheet_lengths(self, mesh):
        width, height = numpy.ptp(mesh.places[:, 1:], axis=0)
        return {"length": self.length_of(mesh), "width": width, "bottom": (self.part.HEIGHT - self.t) / 2 - height}

    def solid(self, lengths, size):
        top, half = self.part.HEIGHT / 2, lengths["width"] / 2
        lines = (
            divide(0.0, lengths["length"], size=2 * size),
            divide(-half, -self.t / 2, self.t / 2, half, size=size),
            divide(lengths["bottom"], top - self.t, top, size=size),
        )
        return Solid(lines, lambda x, y, z: (z > top - self.t) | (numpy.abs(y) < self.t / 2))


    def section(self, lengths, size):
        middle, half = (self.part.HEIGHT - self.t) / 2, lengths["width"] / 2
        ends = [(-half, middle), (half, middle), (0, lengths["bottom"])]
        return [straight((0, middle), end, size) for end in ends]


class BoxStudy(Cantilever):
    def lengths(self):
        return {"length": self.part.LENGTH}

    def sheet_lengths(self, mesh):
        return {"length": self.length_of(mesh)}

    def solid(self, lengths, size):
        y, z = self.part.WIDTH / 2, self.part.HEIGHT / 2
        lines = (
            divide(0.0, lengths["length"], size=2 * size),
            divide(-y, self.t - y, y - self.t, y, size=size),
            divide(-z, self.t - z, z - self.t, z, size=size),
        )
        return Solid(lines, lambda _, v, w: (numpy.abs(v) > y - self.t) | (numpy.abs(w) > z - self.t))


    def section(self, lengths, size):
        y, z = (self.part.WIDTH - self.t) / 2, (self.part.HEIGHT - self.t) / 2
        corners = [(-y, -z), (y, -z), (y, z), (-y, z)]
        return [straight(a, b, size) for a, b in zip(corners, corners[1:] + corners[:1])]


class ArchStudy(Study):
    """Held at its straight rims, under pressure from inside; the compliance is the mean way of its surface."""

    def lengths(self):
        return {"length": self.part.LENGTH, "begin": 0.0}

    def angle(self, places):
        """From one straight rim over the arch; a little less than 0, or more than half a turn, below them."""
        above = numpy.arctan2(-places[:, 1], places[:, 2] + self.part.size[2] / 2)
        return above + numpy.pi / 2

    def sheet_lengths(self, mesh):
        angle = self.angle(mesh.places)
        return {"length": numpy.ptp(mesh.x), "begin": (angle.min() + numpy.pi - angle.max()) / 2}

    def solid(self, lengths, size):
        inner, outer = self.part.RADIUS - self.t / 2, self.part.RADIUS + self.t / 2
        begin = lengths["begin"]
        lines = (
            divide(0.0, lengths["length"], size=2 * size),
            divide(inner, outer, size=size),
            divide(begin, numpy.pi - begin, size=size / self.part.RADIUS),
        )

        def bend(axes):
            x, radius, angle = axes.T
            return numpy.array([x, radius * numpy.cos(angle), radius * numpy.sin(angle) - self.part.size[2] / 2]).T

        return Solid(lines, lambda x, *_: numpy.ones_like(x, bool), bend)

    def section(self, lengths, size):
        angles = divide(lengths["begin"], numpy.pi - lengths["begin"], size=size / self.part.RADIUS)
        line = self.part.RADIUS * numpy.array([numpy.cos(angles), numpy.sin(angles)]).T
        return [line - (0, self.part.size[2] / 2)]

    def result(self, mesh, folder):
        angle, areas = self.angle(mesh.places), mesh.pressed_areas()
        outwards = numpy.array([0 * angle, numpy.cos(angle), numpy.sin(angle)]).T
        low = min(angle.min(), numpy.pi - angle.max())
        near = END * self.t / self.part.RADIUS if isinstance(mesh, ShellMesh) else 1e-6
        is_held = numpy.minimum(angle, numpy.pi - angle) < low + near
        # The pressure is that which makes the area one unit of force.
        return [mesh.compliance(is_held, outwards * areas[:, None] / areas.sum(), folder) * areas.sum()]


class FrequencyStudy(Study):
    """Of a plate that is held at one end."""

    def lengths(self):
        return {"length": self.part.LENGTH, "width": self.part.WIDTH}

    def sheet_lengths(self, mesh):
        return {"length": Cantilever.length_of(mesh), "width": numpy.ptp(mesh.places[:, 1])}

    def solid(self, lengths, size):
        sizes = (lengths["length"], lengths["width"], self.t)
        return Solid([divide(0.0, extent, size=size) for extent in sizes], lambda x, *_: numpy.ones_like(x, bool))

    def section(self, lengths, size):
        return [straight((-lengths["width"] / 2, 0), (lengths["width"] / 2, 0), size)]

    def result(self, mesh, folder):
        return find_frequencies(mesh.model, MATERIAL, mesh.held_nodes(mesh.is_first()), MODES, folder)


STUDIES = {
    "T, bent": lambda thickness, tilt: TeeStudy(Tee(thickness, tilt), False),
    "T, turned": lambda thickness, tilt: TeeStudy(Tee(thickness, tilt), True),
    "box, bent": lambda thickness, tilt: BoxStudy(Box(thickness, tilt), False),
    "box, turned": lambda thickness, tilt: BoxStudy(Box(thickness, tilt), True),
    "arch, pressed": lambda thickness, tilt: ArchStudy(Arch(thickness, tilt)),
    "plate, frequencies": lambda thickness, tilt: FrequencyStudy(Plate(thickness, tilt)),
}


class References:
    """Results of solids, and of shells of the true middle of walls, each made once."""

    def __init__(self, folder):
        self.folder, self.known = folder, {}

    def find(self, key, make):
        if key not in self.known:
            self.known[key] = make()
        return self.known[key]

    def of_solid(self, name, study, lengths, size):
        key = (name, study.t, tuple(round(length, 3) for length in lengths.values()), size)
        return self.find(key, lambda: study.result(SolidMesh(study.solid(lengths, size), study.t), self.folder))

    def of_shell(self, study, lengths, size):
        sheet = Sheet(lengths["length"], study.section(lengths, size), study.t, size)
        places = numpy.array(list(sheet.nodes.values()))
        return study.result(ShellMesh(sheet, places, numpy.eye(3), size), self.folder)


def percent(values, references):
    """Of the value that is farthest off."""
    errors = [100 * (value / reference - 1) for value, reference in zip(values, references)]
    return round(max(errors, key=abs), 2)


def solve_profile(name, thickness, tilt, model, references, folder):
    """Errors of a mesh of the part, in percent: against the part, one cut to the sheet, and a perfect sheet of its lengths."""
    study = STUDIES[name](thickness, tilt)
    places = study.part.to_part(numpy.array(list(model.nodes.values())))
    mesh = ShellMesh(model, places, study.part.axes, thickness)
    found, size = study.result(mesh, folder), thickness / 2
    lengths = study.sheet_lengths(mesh)
    # Smaller elements on the same part: what the solids leave open.
    coarse = references.of_solid(name, study, study.lengths(), size)
    fine = references.of_solid(name, study, study.lengths(), size / 1.5)
    of_sheet = references.of_solid(name, study, lengths, size)
    return {
        "error_percent": percent(found, fine),
        "error_of_sheet_percent": percent(found, [value * a / b for value, a, b in zip(of_sheet, fine, coarse)]),
        "error_of_shell_percent": percent(found, references.of_shell(study, lengths, thickness)),
        "solid_percent": percent(coarse, fine),
    }
