# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Parts of thin walls with known shapes, as volumes: what the studies of shell meshes share. Lengths are in voxels.

A part says which points are inside. Its own axes are x along it, and y and z across; the tilt is the direction of z.
"""

import numpy
from scipy import ndimage

MARGIN = 4
SAMPLES = 256  # of a voxel, for its share of the part
BLUR = 0.5  # of gray volumes, beside that of the voxels

TILTS = {
    "axis": (0, 0, 1),
    "15 degrees": (0.2588, 0, 0.9659),
    "(1,2,5)": (1, 2, 5),
    "(1,1,1)": (1, 1, 1),
    "45 degrees": (1, 0, 1),
}


def axes_of(normal):
    """Length, width and normal of a plate, as rows."""
    w = numpy.array(normal, float) / numpy.linalg.norm(normal)
    u = numpy.array([1.0, 0, 0]) - w[0] * w
    u /= numpy.linalg.norm(u)
    return numpy.array([u, numpy.cross(w, u), w])


def sample_places(number):
    """In a voxel, even along any direction: samples on a grid would lie in layers, as voxels do."""
    ratio = 1.2207440846057596  # the plastic number of three dimensions: its powers are far from fractions
    steps = numpy.arange(number)[:, None] * numpy.power(ratio, [-1, -2, -3])
    return (0.5 + steps) % 1 - 0.5


class Part:
    """In the middle of an image."""

    def __init__(self, size, tilt="axis"):
        """size: of the box around it, whose middle is its origin."""
        self.size = numpy.array(size, float)
        self.tilt, self.axes = tilt, axes_of(TILTS[tilt])
        half = numpy.abs(self.axes.T) @ (self.size / 2)
        self.image = (2 * numpy.ceil(half + MARGIN)).astype(int)
        # Not halfway between voxels, where a plate of three would have four layers.
        self.center = (self.image - 1) // 2 + numpy.array([0.21, 0.33, 0.45])

    def to_part(self, points):
        return (points - self.center) @ self.axes.T

    def inside(self, x, y, z):
        """Whether points are."""
        raise NotImplementedError

    def write(self, path, is_gray, blur=BLUR):
        """As MetaImage: 255 for metal, blurred shares of it at the faces, or only voxels whose middle is inside."""
        offsets = sample_places(SAMPLES) if is_gray else [(0.0, 0.0, 0.0)]
        columns, rows, slices = numpy.ogrid[tuple(slice(0, size) for size in self.image)]
        share = numpy.zeros(self.image)
        for offset in offsets:
            place = [index + by - middle for index, by, middle in zip((columns, rows, slices), offset, self.center)]
            share += self.inside(*(sum(axis[k] * place[k] for k in range(3)) for axis in self.axes))
        share /= len(offsets)
        values = numpy.round(255 * (ndimage.gaussian_filter(share, blur) if is_gray and blur > 0 else share))
        header = (
            "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
            f"ElementSpacing = 1 1 1\nDimSize = {' '.join(map(str, self.image))}\n"
            "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n"
        )
        path.write_bytes(header.encode("ascii") + values.astype(numpy.uint8).T.tobytes())


def is_in_box(places, sizes):
    """Of points, one array for each axis, in a box around the origin."""
    return numpy.logical_and.reduce([numpy.abs(place) <= size / 2 for place, size in zip(places, sizes)])


class Plate(Part):
    LENGTH, WIDTH = 80, 40

    def __init__(self, thickness, tilt="axis"):
        super().__init__((self.LENGTH, self.WIDTH, thickness), tilt)
        self.thickness = thickness

    def inside(self, x, y, z):
        return is_in_box((x, y, z), self.size)

    def thickness_of_voxels(self):
        """What the voxels of a binary plate have in volume for each area: whole layers of voxels where the normal is of integers."""
        normal = TILTS[self.tilt]
        if not all(isinstance(component, int) for component in normal):
            return float(self.thickness)
        step = 1 / numpy.linalg.norm(normal)
        place = self.axes[2] @ self.center
        first = numpy.ceil((place - self.thickness / 2) / step - 1e-9)
        return float(step * (numpy.floor((place + self.thickness / 2) / step + 1e-9) - first + 1))


class Tee(Part):
    """A flange and a web below its middle."""

    LENGTH, WIDTH, HEIGHT = 120, 60, 42

    def __init__(self, thickness, tilt="axis"):
        super().__init__((self.LENGTH, self.WIDTH, self.HEIGHT), tilt)
        self.thickness = thickness

    def inside(self, x, y, z):
        is_flange = self.HEIGHT / 2 - z <= self.thickness
        return is_in_box((x, y, z), self.size) & (is_flange | (numpy.abs(y) <= self.thickness / 2))


class Box(Part):
    """A tube of rectangular section."""

    LENGTH, WIDTH, HEIGHT = 120, 60, 40

    def __init__(self, thickness, tilt="axis"):
        super().__init__((self.LENGTH, self.WIDTH, self.HEIGHT), tilt)
        self.thickness = thickness

    def inside(self, x, y, z):
        hollow = (numpy.inf, self.WIDTH - 2 * self.thickness, self.HEIGHT - 2 * self.thickness)
        return is_in_box((x, y, z), self.size) & ~is_in_box((x, y, z), hollow)


class Arch(Part):
    """Half of a tube along x; its straight rims lie at the bottom."""

    LENGTH, RADIUS = 60, 40

    def __init__(self, thickness, tilt="axis"):
        outer = self.RADIUS + thickness / 2
        super().__init__((self.LENGTH, 2 * outer, outer), tilt)
        self.thickness = thickness

    def inside(self, x, y, z):
        height = z + self.size[2] / 2
        away = numpy.abs(numpy.hypot(y, height) - self.RADIUS)
        return (numpy.abs(x) <= self.LENGTH / 2) & (height >= 0) & (away <= self.thickness / 2)


class Joint(Part):
    """A wall that stands on the middle of a plate."""

    def __init__(self, of_plate, of_wall, tilt="axis"):
        super().__init__((60, 60, 40), tilt)
        self.of_plate, self.of_wall = of_plate, of_wall

    def inside(self, x, y, z):
        is_plate = z + self.size[2] / 2 <= self.of_plate
        return is_in_box((x, y, z), self.size) & (is_plate | (numpy.abs(y) <= self.of_wall / 2))


class Bend(Part):
    """Two walls at a right angle; radius: of the inside of the bend, 0 for a sharp one inside and outside."""

    def __init__(self, thickness, radius, tilt="axis"):
        super().__init__((60, 40, 40), tilt)
        self.thickness, self.radius = thickness, radius

    def inside(self, x, y, z):
        y, z = y + self.size[1] / 2, z + self.size[2] / 2
        outer = self.radius + self.thickness if self.radius > 0 else 0
        is_wall = (y <= self.thickness) | (z <= self.thickness)
        if outer > 0:
            away = numpy.hypot(outer - y, outer - z)
            is_bend = (away >= self.radius) & (away <= outer)
            is_wall = numpy.where((y < outer) & (z < outer), is_bend, is_wall)
        return is_in_box((x, y - self.size[1] / 2, z - self.size[2] / 2), self.size) & is_wall


class HoledPlate(Plate):
    """With a large and two small holes."""

    HOLES = ((0, 0, 10), (-26, 0, 5), (26, 8, 3))  # x, y and radius

    def inside(self, x, y, z):
        is_hole = numpy.logical_or.reduce([numpy.hypot(x - a, y - b) < radius for a, b, radius in self.HOLES])
        return super().inside(x, y, z) & ~is_hole
