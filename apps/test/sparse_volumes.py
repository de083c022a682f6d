# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Volumes far larger than the disk that they take: a few objects among holes, and what is around each of them."""

import contextlib
import math
import os

import volumes

MARGIN = 6


class Object:
    """Runs (x begin, x end, y, z) of voxels, sorted along z, y, x."""

    def __init__(self, runs):
        self.runs = sorted(runs, key=lambda run: (run[3], run[2], run[0]))

    def box(self, size):
        """Lower and upper corner of a box around the object that ends with the volume."""
        lower = [min(run[i] for run in self.runs) - MARGIN for i in (0, 2, 3)]
        upper = [max(run[i] for run in self.runs) + MARGIN + (i != 1) for i in (1, 2, 3)]
        return [max(0, c) for c in lower], [min(c, n) for c, n in zip(upper, size)]


def block(lower, upper):
    return [(lower[0], upper[0], y, z) for z in range(lower[2], upper[2]) for y in range(lower[1], upper[1])]


def plate(lower, extent):
    return Object(block(lower, [c + n for c, n in zip(lower, extent)]))


def hollow_box(lower, upper, wall):
    """Six walls; those at the end of a volume are cut off by giving an upper corner beyond it."""
    inner_lower, inner_upper = [c + wall for c in lower], [c - wall for c in upper]
    runs = []
    for begin, end, y, z in block(lower, upper):
        if inner_lower[1] <= y < inner_upper[1] and inner_lower[2] <= z < inner_upper[2]:
            runs += [(begin, inner_lower[0], y, z), (inner_upper[0], end, y, z)]
        else:
            runs.append((begin, end, y, z))
    return runs


def clipped(runs, size):
    return Object((max(0, b), min(e, size[0]), y, z) for b, e, y, z in runs if b < size[0] and y < size[1] and z < size[2])


def shell(center, inner, outer):
    """Voxels at distances from inner up to outer, the latter not included."""
    runs = []
    for z in range(center[2] - outer, center[2] + outer + 1):
        for y in range(center[1] - outer, center[1] + outer + 1):
            rest = (y - center[1]) ** 2 + (z - center[2]) ** 2
            if rest >= outer * outer:
                continue
            half = math.isqrt(outer * outer - rest - 1)
            if rest >= inner * inner:
                runs.append((center[0] - half, center[0] + half + 1, y, z))
            else:
                hollow = math.isqrt(inner * inner - rest - 1)
                runs.append((center[0] - half, center[0] - hollow, y, z))
                runs.append((center[0] + hollow + 1, center[0] + half + 1, y, z))
    return Object(run for run in runs if run[0] < run[1])


def tilted_plate(lower, length, height, thickness):
    """Rises by one voxel along y every three voxels along x."""
    x, y, z = lower
    steps = range(0, length, 3)
    return Object((x + s, x + s + 3, y + s // 3 + t, z + h) for s in steps for t in range(thickness) for h in range(height))


def scattered_objects(size):
    """Objects near both ends, in the middle, and where offsets need more than 32 bits; far from each other."""
    far = list(size)
    objects = [
        shell((45, 45, 45), 27, 30),
        plate((size[0] // 2 - 150, 200, size[2] // 3), (300, 140, 3)),
        plate((300, size[1] // 2, size[2] // 2 - 40), (120, 2, 80)),
        tilted_plate((100, size[1] - 300, 2 * size[2] // 3), 240, 50, 4),
        shell((size[0] - 80, 90, size[2] - 60), 40, 46),
        clipped(hollow_box([c - 70 for c in far], [c + 10 for c in far], 4), size),
    ]
    for bits in (32, 33, 35):
        slice_index, rest = divmod(1 << bits, size[0] * size[1])
        row, column = divmod(rest, size[0])
        if 40 < slice_index < size[2] - 140:
            # The rows on both sides of the voxel with that offset.
            center = (min(max(column, 40), size[0] - 40), min(max(row, 40), size[1] - 40), slice_index)
            objects.append(shell(center, 22, 26))
    return objects


def write_sparse(path, size, objects, header=b"", allocate=False):
    """A file with value 1 at the objects; holes, or zeros that take space, between them."""
    number_of_bytes = math.prod(size)
    with open(path, "wb") as file:
        file.write(header)
        if allocate:
            zeros = bytes(1 << 24)
            for begin in range(0, number_of_bytes, len(zeros)):
                file.write(zeros[: number_of_bytes - begin])
        file.truncate(len(header) + number_of_bytes)
        file.flush()
        for thing in objects:
            for begin, end, y, z in thing.runs:
                offset = len(header) + (z * size[1] + y) * size[0]
                os.pwrite(file.fileno(), b"\1" * (end - begin), offset + begin)
    return path


def crop(thing, size):
    """The box around an object as a volume of its own."""
    lower, upper = thing.box(size)
    extent = [u - c for c, u in zip(lower, upper)]
    data = bytearray(math.prod(extent))
    for begin, end, y, z in thing.runs:
        offset = ((z - lower[2]) * extent[1] + y - lower[1]) * extent[0] - lower[0]
        data[offset + begin : offset + end] = b"\1" * (end - begin)
    volume = volumes.Volume(extent, [])
    volume.voxels = bytes(data)
    return volume


def read_box(path, size, lower, upper):
    """Voxels of a box of an uncompressed volume of bytes that ends with its file."""
    rows = []
    with open(path, "rb") as file:
        start = os.fstat(file.fileno()).st_size - math.prod(size)
        for z in range(lower[2], upper[2]):
            for y in range(lower[1], upper[1]):
                offset = start + (z * size[1] + y) * size[0] + lower[0]
                rows.append(os.pread(file.fileno(), upper[0] - lower[0], offset))
    return b"".join(rows)


def extents_of_data(file, begin):
    """Ranges of a file from an offset on that are no holes."""
    # Beyond the last data the system answers with an error.
    with contextlib.suppress(OSError):
        while True:
            begin = os.lseek(file.fileno(), begin, os.SEEK_DATA)
            end = os.lseek(file.fileno(), begin, os.SEEK_HOLE)
            yield begin, end
            begin = end


def count_set_voxels(path, size):
    """Number of voxels that are not zero, holes skipped."""
    piece = 1 << 24
    count = 0
    with open(path, "rb") as file:
        start = os.fstat(file.fileno()).st_size - math.prod(size)
        for begin, end in extents_of_data(file, start):
            for offset in range(begin, end, piece):
                data = os.pread(file.fileno(), min(piece, end - offset), offset)
                count += len(data) - data.count(0)
    return count


def allocated_bytes(path):
    return os.stat(path).st_blocks * 512
