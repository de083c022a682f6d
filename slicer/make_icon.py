#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Draws the icon of the extension: a section through walls, and their medial line.

Usage: slicer/make_icon.py OUTPUT.png
"""

import math
import struct
import sys
import zlib

SIZE, SAMPLES = 128, 4
WALL, LINE, REACH = 15.0, 4.0, 14.0  # half widths, and how far the geodesic color reaches from a junction
JUNCTION = (58.0, 62.0)
SEGMENTS = [((18.0, 20.0), (18.0, 62.0)), ((18.0, 62.0), (110.0, 62.0)), (JUNCTION, (88.0, 110.0))]
NOTHING, OBJECT, BY_BOUND, BY_GEODESIC = (0, 0, 0, 0), (95, 95, 100, 255), (255, 255, 255, 255), (255, 45, 35, 255)


def distance(point, segment):
    (ax, ay), (bx, by) = segment
    dx, dy = bx - ax, by - ay
    along = ((point[0] - ax) * dx + (point[1] - ay) * dy) / (dx * dx + dy * dy)
    along = min(1.0, max(0.0, along))
    return math.hypot(point[0] - ax - along * dx, point[1] - ay - along * dy)


def color_at(point):
    nearest = min(distance(point, segment) for segment in SEGMENTS)
    if nearest > WALL:
        return NOTHING
    if nearest > LINE:
        return OBJECT
    return BY_GEODESIC if math.dist(point, JUNCTION) < REACH else BY_BOUND


def average(colors):
    """Mean color; the colors count as much as they cover."""
    cover = sum(color[3] for color in colors)
    if not cover:
        return NOTHING
    mixed = (round(sum(color[k] * color[3] for color in colors) / cover) for k in range(3))
    return (*mixed, round(cover / len(colors)))


def pixel(x, y):
    offsets = [(k + 0.5) / SAMPLES for k in range(SAMPLES)]
    return average([color_at((x + dx, y + dy)) for dy in offsets for dx in offsets])


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    rows = b"".join(b"\0" + bytes(v for x in range(SIZE) for v in pixel(x, y)) for y in range(SIZE))
    header = struct.pack(">IIBBBBB", SIZE, SIZE, 8, 6, 0, 0, 0)
    with open(sys.argv[1], "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


if __name__ == "__main__":
    main()
